// The table of the fields of the flow.
#include "src/fluid/fluid_fields.hpp"

#include <gtest/gtest.h>

#include <set>
#include <string>

#include "src/case/config.hpp"
#include "src/fluid/domain.hpp"
#include "src/fluid/fluid_state.hpp"
#include "src/io/frame_file.hpp"
#include "src/parallel/mirror.hpp"
#include "src/restart/state_file.hpp"
#include "src/results/output_files.hpp"
#include "tests/support/temporary_folder.hpp"

namespace barchan {
namespace {

const Config kChannel = [] {
  Config c;
  c.size = {0.04, 0.02, 0.02};
  c.fluid = FluidConfig{.cells = {8, 6, 4}};
  return c;
}();

// Whatever the table lists is allocated, goes through a restart file and, if it is for frames, into
// fields.h5. So a new field is a member and a line of the table.
TEST(FluidFields, AllOfTheTableAreAllocatedRestartedAndShown) {
  const TemporaryFolder folder;
  const Grid grid = make_grid(kChannel);
  SystemState there, back;
  there.fluid = make_fluid_state(grid);
  back.fluid = make_fluid_state(grid);
  std::set<std::string> names, in_frames;
  int n = 0;
  for_each_fluid_field(*there.fluid, [&](auto& member, const FluidField& field) {
    EXPECT_TRUE(names.insert(field.name).second) << field.name << " is there twice";
    for_each_component(member, [&](const Field& f, const char* component) {
      ASSERT_GT(f.storage.size(), 0u) << field.name;
      Kokkos::deep_copy(f.storage, Real(++n));
      if ((field.uses & kInFrame) == 0) return;
      const std::string name = std::string(field.name) + component;
      in_frames.insert(name == "u_x" ? "u" : name == "u_y" ? "v" : name == "u_z" ? "w" : name);
    });
  });
  CheckpointWriter writer(folder.path(), 1, {});
  save_state(writer, there, nullptr);
  load_state(CheckpointReader(writer.commit(1)), back, nullptr);
  n = 0;
  for_each_fluid_field(*back.fluid, [&](auto& member, const FluidField& field) {
    for_each_component(member, [&](const Field& f, const char* component) {
      const auto host = host_copy(f.storage);
      const Real wanted = (field.uses & kInRestart) != 0 ? ++n : (++n, field.at_rest);
      EXPECT_EQ(host.data()[host.size() / 2], wanted) << field.name << component;
    });
  });
  OutputFiles(folder.path(), {}, {}).write_fields(*there.fluid, 0, 0);
  std::set<std::string> written;
  const Hdf5File file(folder / "fields.h5", Hdf5File::Mode::read);
  const std::vector<FrameInfo> frames = list_frames(file);
  for (const auto& [name, info] : frames.at(0).arrays) written.insert(name);
  EXPECT_EQ(written, in_frames);
}

TEST(FluidFields, AFlowAtRestIsWaterWithoutGrains) {
  const FluidState s = make_fluid_state(make_grid(kChannel));
  for (const Field& f : {s.alpha_f, s.alpha_f_previous, s.p, s.u.x, s.du_dt.z}) {
    const auto host = host_copy(f.storage);
    const bool fraction = f.storage.label().find("alpha") != std::string::npos;
    for (std::size_t q = 0; q < host.size(); ++q) ASSERT_EQ(host.data()[q], fraction ? 1 : 0);
  }
}

}  // namespace
}  // namespace barchan
