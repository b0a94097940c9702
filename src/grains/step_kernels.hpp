// Launch of the kernels of grain steps, one by one or all together.
#pragma once

#include <Kokkos_Graph.hpp>
#include <optional>
#include <string>

#include "src/parallel/launch.hpp"

namespace barchan {

/// Takes kernels one after another: launches them, or makes them the nodes of a graph, which a
/// device takes in one launch and goes through faster. The graph can be launched again as long as
/// the data of its kernels stay where they are. On a host there is nothing to gain.
class StepKernels {
  using Space = Kokkos::DefaultExecutionSpace;

 public:
  /// Puts the kernels that follow into a new graph, until end_graph().
  void begin_graph() {
    graph_.emplace();
    last_.emplace(graph_->root_node());
  }
  void end_graph() {
    last_.reset();
    graph_->instantiate();
  }
  void drop_graph() { graph_.reset(); }
  bool has_graph() const { return graph_.has_value(); }
  /// Launches the graph. Kokkos' tools see it as one kernel.
  void launch_graph(const char* label) const {
    const Space space;
    std::uint64_t id = 0;
    Kokkos::Profiling::beginParallelFor(label, Kokkos::Profiling::Experimental::device_id(space),
                                        &id);
    graph_->submit(space);
    Kokkos::Profiling::endParallelFor(id);
  }

  template <class Functor>
  void for_each(const char* label, int n, const Functor& functor) {
    if constexpr (!kOnHost) {
      if (last_) {
        last_ = last_->then_parallel_for(std::string(label), items(n), functor);
        return;
      }
    }
    Kokkos::parallel_for(label, items(n), functor);
  }
  /// Reduces into a number on the device.
  template <class Functor, class Result>
  void reduce(const char* label, int n, const Functor& functor, Result result) {
    if constexpr (!kOnHost) {
      if (last_) {
        last_ = last_->then_parallel_reduce(std::string(label), items(n), functor, result);
        return;
      }
    }
    Kokkos::parallel_reduce(label, items(n), functor, result);
  }

 private:
  std::optional<Kokkos::Experimental::Graph<Space>> graph_;
  std::optional<Kokkos::Experimental::GraphNodeRef<Space>> last_;
};

}  // namespace barchan
