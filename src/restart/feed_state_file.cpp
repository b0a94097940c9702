#include "src/restart/feed_state_file.hpp"

#include <span>
#include <string>
#include <vector>

#include "kernels/grains/law_table.hpp"

namespace barchan {

namespace {

std::uint64_t entries(const CheckpointReader& file, const std::string& name) {
  const Extents extents = file.extents(name);
  if (extents.empty()) file.fail(name + " is not an array");
  return extents[0];
}

constexpr std::uint64_t kBodyNumbers = sizeof(GrainBody) / sizeof(double);

void save_bodies(CheckpointWriter& file, const std::string& name,
                 const std::vector<GrainBody>& bodies) {
  const std::span numbers(reinterpret_cast<const double*>(bodies.data()),
                          kBodyNumbers * bodies.size());
  file.array(name, numbers, {bodies.size(), kBodyNumbers});
}

std::vector<GrainBody> load_bodies(const CheckpointReader& file, const std::string& name) {
  const std::vector<double> numbers = file.array<double>(name, {entries(file, name), kBodyNumbers});
  std::vector<GrainBody> bodies;
  for (std::size_t k = 0; k + 2 < numbers.size(); k += kBodyNumbers) {
    bodies.push_back({numbers[k], numbers[k + 1], numbers[k + 2]});
    const auto& [r, m, kind] = bodies.back();
    if (!(r > 0 && m > 0 && kind >= 0 && kind < kMaxKinds))
      file.fail(name + " holds a grain that makes no sense");
  }
  return bodies;
}

}  // namespace

void save_feed(CheckpointWriter& file, const FeedState& feed) {
  if (feed.next_id == 0) return;
  file.scalar("feed/n_fed", feed.n_fed);
  file.scalar("feed/next_id", feed.next_id);
  file.scalar("feed/n_tries", feed.n_tries);
  file.scalar("feed/due", feed.due);
  file.scalar("feed/n_asked", feed.n_asked);
  save_bodies(file, "feed/bodies", feed.bodies);
  save_bodies(file, "feed/waiting", feed.waiting);
}

FeedState load_feed(const CheckpointReader& file) {
  FeedState feed;
  if (file.has("step")) feed.n_steps = file.integer("step");
  if (!file.has("feed/n_fed")) return feed;
  feed.n_fed = file.integer("feed/n_fed");
  feed.next_id = file.integer("feed/next_id");
  feed.n_tries = file.integer("feed/n_tries");
  feed.due = file.real("feed/due");
  feed.n_asked = file.integer("feed/n_asked");
  feed.bodies = load_bodies(file, "feed/bodies");
  feed.waiting = load_bodies(file, "feed/waiting");
  if (feed.n_fed < 0 || feed.n_tries < 0 || feed.n_asked < 0 || feed.next_id <= 0)
    file.fail("the numbers of its feed of grains make no sense");
  return feed;
}

}  // namespace barchan
