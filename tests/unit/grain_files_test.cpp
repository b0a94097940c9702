
#include <gtest/gtest.h>

#include <ctime>
#include <fstream>

#include "src/grains/grain_state.hpp"
#include "src/initial/grain_files.hpp"
#include "src/initial/grain_table.hpp"
#include "src/restart/checkpoint.hpp"
#include "src/results/output_files.hpp"
#include "tests/support/sanitized.hpp"
#include "tests/support/temporary_folder.hpp"

namespace barchan {
namespace {

InitialGrains parse(const std::string& text) { return parse_grains_csv(text, "heap.csv"); }
std::string problem(const std::string& text) {
  return message_of([&text] { parse(text); });
}

TEST(GrainFiles, ReadsASettledHeap) {
  const auto grains = parse(
      "id,diameter,x,y,z\n"
      "1,0.0002,0.04005775535,9.995644763e-05,0.04999777035\n"
      "2,0.0002,0.04026187579,9.996611585e-05,0.04997720662\n"
      "3,0.00025,0.04006288333,9.990457026e-05,0.050201205\n");
  ASSERT_EQ(grains.size(), 3u);
  EXPECT_EQ(grains.id, (std::vector<std::int64_t>{1, 2, 3}));
  EXPECT_EQ(grains.diameter[2], 0.00025);
  EXPECT_EQ(grains.x[1].x, 0.04026187579);
  EXPECT_EQ(grains.x[1].y, 9.996611585e-05);
  EXPECT_EQ(grains.x[1].z, 0.04997720662);
  EXPECT_EQ(grains.u[1].x, 0.0);
  EXPECT_EQ(grains.omega.size(), 3u);
}

TEST(GrainFiles, ColumnsInAnyOrderWithVelocityAndSpin) {
  const auto grains = parse(
      "\xEF\xBB\xBF# from elsewhere\r\n"
      "wz, z,y ,x,diameter,id,vx,vy,vz,wx,wy\r\n"
      "\r\n"
      "9,3,2,+1,0.5,-4,0.1,0.2,0.3,7,8\r\n"
      "# between\r\n"
      "9,3,2,1,0.5,5,0.1,0.2,0.3,7,8");
  ASSERT_EQ(grains.size(), 2u);
  EXPECT_EQ(grains.id[0], -4);
  EXPECT_EQ(grains.x[0].x, 1.0);
  EXPECT_EQ(grains.x[0].y, 2.0);
  EXPECT_EQ(grains.x[0].z, 3.0);
  EXPECT_EQ(grains.u[0].z, 0.3);
  EXPECT_EQ(grains.omega[0].x, 7.0);
  EXPECT_EQ(grains.omega[0].z, 9.0);
}

/// Table as run.grains().to_csv() writes it: titles in the order of the arrays in a frame.
TEST(GrainFiles, TableOfThePythonPackage) {
  const auto grains = parse(
      "id,d,dune,force_total_x,force_total_y,force_total_z,kind,omega_x,omega_y,omega_z,u,v,w,x,y,"
      "z\n"
      "7,0.0002,-1,1e-9,2e-9,,1,4,5,6,0.1,0.2,0.3,0.01,0.02,0.03\n");
  ASSERT_EQ(grains.size(), 1u);
  EXPECT_EQ(grains.id[0], 7);
  EXPECT_EQ(grains.diameter[0], 2e-4);
  EXPECT_EQ(grains.x[0].z, 0.03);
  EXPECT_EQ(grains.u[0].y, 0.2);
  EXPECT_EQ(grains.omega[0].x, 4);
  EXPECT_EQ(grains.kind_names, std::vector<std::string>{"1"});
}

TEST(GrainFiles, TableOfNumpy) {
  const auto grains = parse(
      "# of a notebook\n# id,radius,x,y,z\n"
      "1.000000000000000000e+00,1.0e-04,1.0e-02,2.0e-02,3.0e-02\n"
      "2.000000000000000000e+00,1.5e-04,1.0e-02,2.0e-02,4.0e-02\n");
  ASSERT_EQ(grains.size(), 2u);
  EXPECT_EQ(grains.id[1], 2);
  EXPECT_EQ(grains.diameter[1], 3e-4) << "twice the radius";
  EXPECT_EQ(grains.x[1].z, 0.04);
  EXPECT_EQ(problem("# id,radius,x,y\n1,1,1,1\n"),
            "heap.csv:2: column \"z\" is missing; needed are id,diameter,x,y,z");
  EXPECT_EQ(problem("# id,radius,x,y,z\n9.1e15,1,1,1,1\n"),
            "heap.csv:2: id = \"9.1e15\": must be a whole number");
}

TEST(GrainFiles, LikelyCausesAreNamed) {
  const auto says = [](const std::string& text, const std::string& words) {
    const std::string told = problem(text);
    EXPECT_NE(told.find(words), std::string::npos) << told;
  };
  says("id;diameter;x;y;z\n1;0,1;0;0;0\n", "heap.csv:1: values are separated by semicolons");
  says("id\tdiameter\tx\ty\tz\n", "heap.csv:1: values are separated by tabs");
  says("id diameter x y z\n", "heap.csv:1: values are separated by spaces");
  says("id,diameter,x,y,z\n1,0,1,0,2,0,3,0,4\n",
       "heap.csv:2: 9 values, but the header has 5 columns; are there decimal commas?");
  says("1,2e-4,0,0,0\n", "heap.csv:1: the header is missing");
  says("ID,diameter,x,y,z\n", "did you mean \"id\"?");
  says("id,diameter [m],x,y,z\n", "did you mean \"diameter\"?");
  says("id,,diameter,x,y,z\n", "column 2 has no name");
  says("\"id\",\"diameter\",\"x\",\"y\",\"z\"\n", "titles stand without quotes");
  says("id,diameter,x,y,z\n1,\"2e-4\",0,0,0\n", "must be a number, without quotes");
  says("id,diameter,x,y,z\n99999999999999999999,1,0,0,0\n",
       "id = 99999999999999999999: must be at most 9223372036854775807");
  says("id,diameter,x,y,z\r1,1,0,0,0\r", "carriage returns alone");
  says("\xFF\xFEi", "UTF-16");
  says("\x89HDF\r\n", "it is an HDF5 file");
  says(std::string("PK\3\4\0", 5), "not text");
  says(std::string("id,diameter,x,y,z\n1,2e-4\0,0,0,0\n", 31),
       "diameter = \"2e-4\\x00\": must be a number");
}

TEST(GrainFiles, ProblemsNameFileAndLine) {
  const std::string head = "id,diameter,x,y,z\n";
  EXPECT_EQ(problem("id,diameter,x,z\n1,1,1,1\n"),
            "heap.csv:1: column \"y\" is missing; needed are id,diameter,x,y,z");
  EXPECT_EQ(problem("id,diameter,x,y,z,radius\n"),
            "heap.csv:1: unknown column \"radius\" in the header (did you mean \"diameter\"?); "
            "columns are id,diameter,x,y,z and optionally "
            "vx,vy,vz,wx,wy,wz,kind,heap");
  EXPECT_EQ(problem("id,diameter,x,y,z,x\n"), "heap.csv:1: column \"x\" appears twice");
  EXPECT_EQ(problem(head + "1,1,0,0,0\n2,1,0,zero,0\n"),
            "heap.csv:3: y = \"zero\": must be a number");
  EXPECT_EQ(problem(head + "1,1,0,0,\n"), "heap.csv:2: z = \"\": must be a number");
  EXPECT_EQ(problem(head + "1,1,0,0,1e999\n"), "heap.csv:2: z = \"1e999\": must be a number");
  EXPECT_EQ(problem(head + "1,1,0,0,0x10\n"), "heap.csv:2: z = \"0x10\": must be a number");
  EXPECT_EQ(problem(head + "1,1,nan,0,0\n"), "heap.csv:2: x = nan: must be finite");
  EXPECT_EQ(problem(head + "1,1,0,-inf,0\n"), "heap.csv:2: y = -inf: must be finite");
  EXPECT_EQ(problem(head + "1.5,1,0,0,0\n"), "heap.csv:2: id = \"1.5\": must be a whole number");
  EXPECT_EQ(problem(head + "1,0,0,0,0\n"), "heap.csv:2: diameter = 0: must be above 0");
  EXPECT_EQ(problem(head + "1,-2e-4,0,0,0\n"), "heap.csv:2: diameter = -0.0002: must be above 0");
  EXPECT_EQ(problem(head + "1,1,0,0\n"), "heap.csv:2: 4 values, but the header has 5 columns");
  EXPECT_EQ(problem(head + "1,1,0,0,0,0\n"), "heap.csv:2: 6 values, but the header has 5 columns");
  EXPECT_EQ(problem(head + "1,1,0,0,0\n\n# c\n2,1,0,0,0\n1,1,1,1,1\n"),
            "heap.csv:6: id 1 was used before, in line 2");
  EXPECT_EQ(problem(""),
            "heap.csv:1: it is empty; needed is a header, id,diameter,x,y,z, and a line a grain");
  EXPECT_EQ(problem(head), "heap.csv:1: it has a header but no grains");
}

TEST(GrainFiles, FilesByTheirEnding) {
  const TemporaryFolder folder;
  std::ofstream(folder / "a.csv") << "id,diameter,x,y,z\n1,2,3,4,5\n";
  EXPECT_EQ(read_grains(folder / "a.csv").size(), 1u);
  EXPECT_EQ(message_of([&] { read_grains(folder / "no.csv"); }),
            "cannot read " + (folder / "no.csv").string() + ": No such file or directory");
  EXPECT_NE(message_of([&] { read_grains(folder / "a.txt"); }).find("must end with .csv or .h5"),
            std::string::npos);
}

TEST(GrainFiles, AHundredThousandRowsAreQuick) {
  std::string text = "id,diameter,x,y,z\n";
  for (int p = 0; p < 100000; ++p) {
    text += std::to_string(p) + ",0.0002,0.0399146060" + std::to_string(p) +
            ",9.990869211e-05,0.04990389532\n";
  }
  const auto cpu_seconds = [] {  // a busy machine must not count
    timespec time{};
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &time);
    return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
  };
  const double start = cpu_seconds();
  const auto grains = parse(text);
  const double seconds = cpu_seconds() - start;
  EXPECT_EQ(grains.size(), 100000u);
  EXPECT_LT(test::kSanitized ? 0 : seconds, 0.3);  // about 0.03 s
}

GrainState two_grains() {
  InitialGrains g;
  g.id = {70, 69, 68};
  g.diameter = {2e-4, 2e-4, 2e-4};
  for (int p = 0; p < 3; ++p) {
    g.x.push_back({0.1 + p, 0.2, 0.3});
    g.u.push_back({1.0, 2.0, 3.0 + p});
    g.omega.push_back({4.0, 5.0, 6.0});
  }
  GrainState state = make_grain_state(g, 2500);
  state.n = 2;  // one row more than grains
  return state;
}

void expect_two_grains(const InitialGrains& grains) {
  ASSERT_EQ(grains.size(), 2u);
  EXPECT_EQ(grains.id, (std::vector<std::int64_t>{70, 69}));
  EXPECT_EQ(grains.diameter[1], 2e-4);
  EXPECT_EQ(grains.x[1].x, 1.1);
  EXPECT_EQ(grains.u[1].z, 4.0);
  EXPECT_EQ(grains.omega[0].y, 5.0);
}

TEST(GrainFiles, TheLastFrameOfAResult) {
  const TemporaryFolder folder;
  OutputFiles output(folder.path(), {});
  GrainState state = two_grains();
  state.n = 1;
  output.write_grains(state, 0.0, 0);
  state.n = 2;
  output.write_grains(state, 0.1, 10);
  expect_two_grains(read_grains(folder / "grains.h5"));
}

/// Grains beyond a side that was periodic there; where it is an outlet here they would be outside.
TEST(GrainFiles, PositionsAreWithinTheBoxThatWroteThem) {
  const TemporaryFolder folder;
  const Provenance origin{
      .config =
          "[domain]\nsize = [0.5, 1, 0.4]\n[grains]\nboundary_x = \"periodic\"\n"
          "boundary_z = \"periodic\"\n"};
  InitialGrains g;
  g.add(1, 2e-4, {-1e-5, 0.5, 0.40001});
  const GrainState state = make_grain_state(g, 2500);
  CheckpointWriter writer(folder.path(), 5, origin);
  writer.array("grains/id", state.id);
  writer.array("grains/kin", state.kin);
  OutputFiles(folder.path(), origin).write_grains(state, 0, 0);
  for (const auto& file : {writer.commit(1), folder / "grains.h5"}) {
    const InitialGrains read = read_grains(file);
    ASSERT_EQ(read.size(), 1u);
    EXPECT_DOUBLE_EQ(read.x[0].x, 0.49999) << file;
    EXPECT_NEAR(read.x[0].z, 1e-5, 1e-15) << file;
  }
}

/// A number is not given again when its grain has left: files know the last one.
TEST(GrainFiles, KeepTheLastNumber) {
  const TemporaryFolder folder;
  GrainState state = two_grains();
  state.last_id = 90;
  OutputFiles(folder.path(), {}).write_grains(state, 0, 0);
  EXPECT_EQ(read_grains(folder / "grains.h5").last_id, 90);
  state.feed.next_id = 95;
  EXPECT_EQ(last_id(state), 94);
  EXPECT_EQ(two_grains().last_id, 70);
}

TEST(GrainFiles, ARestartFile) {
  const TemporaryFolder folder;
  const GrainState state = two_grains();
  CheckpointWriter writer(folder.path(), 5, {});
  const auto rows = std::make_pair(0, state.n);
  writer.array("grains/id", Kokkos::subview(state.id, rows));
  writer.array("grains/kin", Kokkos::subview(state.kin, rows));
  expect_two_grains(read_grains(writer.commit(1)));
}

}  // namespace
}  // namespace barchan
