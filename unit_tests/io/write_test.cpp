#include <sys/resource.h>

#include <algorithm>
#include <csignal>

#include <gtest/gtest.h>

#include <gale/io/atomic_file.hpp>
#include <gale/io/read.hpp>
#include <gale/io/synthetic.hpp>
#include <gale/io/write.hpp>
#include <gale/io/writers/writers.hpp>

#include "io/io_fixtures.hpp"

namespace gale::io {
namespace {

using test::content_of;
using test::error_of;
using Names = std::set<std::string>;

class WriteMesh : public test::FileTest {};
class WriteAndRead : public test::VtkTest {};
class WritePoints : public test::FileTest {};

Dataset grid_with_every_type(int n) {
  Dataset mesh = make_grid(n);
  mesh.arrays = test::arrays_of_every_type(test::point_count_of(mesh));
  return mesh;
}

/// Has coordinates that float cannot hold.
Dataset with_double_points(Dataset mesh) {
  const Dataset::Points<double> points("GALE::points", test::point_count_of(mesh));
  for (std::size_t i = 0; i < points.extent(0); ++i) {
    for (int d = 0; d < 3; ++d) points(i, d) = 0.1 * static_cast<double>(3 * i + d);
  }
  mesh.points = points;
  return mesh;
}

TEST_F(WriteAndRead, ComesBackAsItWas) {
  for (const std::string name : {"mesh.vtu", "mesh.vtk", "MESH.VTU"}) {
    for (const Dataset& mesh : {grid_with_every_type(3), with_double_points(grid_with_every_type(3))}) {
      write_mesh(folder / name, mesh);
      test::expect_same(read(folder / name), mesh);
    }
  }
  EXPECT_EQ(folder.names(), (Names{"mesh.vtu", "mesh.vtk", "MESH.VTU"}));
}

TEST_F(WriteAndRead, AppendsAndReplacesArrays) {
  const Dataset mesh = make_grid(2);
  const std::vector<float> other(8, 7);
  write_mesh(folder / "mesh.vtu", mesh, {{"extra", 1, std::vector<std::int64_t>(8, -1)}, {"field", 1, other}});
  const Dataset back = read(folder / "mesh.vtu");
  ASSERT_EQ(test::names_of(back.arrays), (std::vector<std::string>{"field", "extra"}));
  EXPECT_EQ(test::values_of<float>(back.arrays[0]), other);
}

PointSet three_points() {
  const Dataset::Points<float> points("GALE::points", 3);
  for (int i = 0; i < 3; ++i) points(i, 0) = static_cast<float>(i);
  return {points, {{"CriticalType", 1, std::vector<std::int8_t>{0, 3, 1}}}};
}

TEST_F(WritePoints, WritesVertexCellsAndArrays) {
  write_points(folder / "points.vtp", three_points());
  const std::string content = content_of(folder / "points.vtp");
  EXPECT_NE(content.find(R"(type="PolyData")"), std::string::npos);
  EXPECT_NE(content.find(R"(NumberOfPoints="3")"), std::string::npos);
  EXPECT_NE(content.find(R"(NumberOfVerts="3")"), std::string::npos);
  EXPECT_NE(content.find(R"(type="Int8" Name="CriticalType")"), std::string::npos);
  EXPECT_EQ(folder.names(), Names{"points.vtp"});
}

TEST_F(WritePoints, WritesNoPointsToo) {
  write_points(folder / "points.vtp", {Dataset::Points<double>("GALE::points", 0), {{"id", 1, std::vector<int>{}}}});
  EXPECT_NE(content_of(folder / "points.vtp").find(R"(NumberOfPoints="0")"), std::string::npos);
}

TEST_F(WriteMesh, RefusesArraysOfAnotherLength) {
  Dataset mesh = make_grid(2);
  mesh.arrays.push_back({"pairs", 2, std::vector<float>(15)});
  const std::string path = folder / "mesh.vtu";
  EXPECT_EQ(error_of([&] { write_mesh(path, mesh); }),
            "cannot write '" + path + "': the array 'pairs' has 15 values for 8 points of 2 components");
  EXPECT_EQ(error_of([&] {
              write_mesh(path, make_grid(2), {{"ids", 1, std::vector<int>(9)}});
            }),
            "cannot write '" + path + "': the array 'ids' has 9 values for 8 points of 1 components");
  mesh.arrays.pop_back();
  mesh.tetrahedra(1, 2) = 99;
  EXPECT_EQ(error_of([&] { write_mesh(path, mesh); }), "cannot write '" + path + "': there is no point 99 among 8");
  EXPECT_EQ(folder.names(), Names{});
}

TEST_F(WriteMesh, RefusesOtherExtensions) {
  EXPECT_EQ(error_of([] { write_mesh("mesh.vtp", make_grid(2)); }),
            "cannot write a mesh to 'mesh.vtp': its extension is neither .vtu nor .vtk nor .hdf nor .vtkhdf");
  EXPECT_EQ(error_of([] { write_points("points.vtu", three_points()); }),
            "cannot write points to 'points.vtu': its extension is neither .vtp nor .hdf nor .vtkhdf");
}

TEST_F(WriteMesh, NamesStepsInTwoFormats) {
  const std::vector<Step> steps = {{-0.5, "a \"0\".vtu"}, {1e30, "b.vtu"}};
  for (const char* const name : {"run.pvd", "run.vtu.series"}) {
    AtomicFile file(folder / name);
    write_series(file, steps);
    file.commit();
  }
  EXPECT_EQ(content_of(folder / "run.vtu.series"),
            "{\n  \"file-series-version\" : \"1.0\",\n  \"files\" : [\n"
            "    { \"name\" : \"a \\\"0\\\".vtu\", \"time\" : -0.5 },\n"
            "    { \"name\" : \"b.vtu\", \"time\" : 1e+30 }\n  ]\n}\n");
  EXPECT_NE(content_of(folder / "run.pvd").find("timestep=\"1e+30\" part=\"0\" file=\"b.vtu\""), std::string::npos);
  for (const char* const name : {"run.vtp", "run", "run.xml"}) {
    const AtomicFile file(folder / name);
    EXPECT_EQ(error_of([&] { write_series(file, steps); }),
              "cannot write '" + (folder / name) + "': a series ends with .pvd or .series");
  }
}

TEST_F(WriteMesh, RefusesNamesThatHdf5HasNot) {
  PointSet points = three_points();
  points.arrays.front().name = "of/all";
  EXPECT_EQ(error_of([&] { write_points(folder / "points.vtkhdf", points); }),
            "cannot write '" + (folder / "points.vtkhdf") + "': HDF5 has no array that is called 'of/all'");
  EXPECT_EQ(folder.names(), Names{});
}

TEST_F(WriteMesh, RefusesNamesThatLegacyVtkHasNot) {
  Dataset mesh = make_grid(2);
  const std::string path = folder / "mesh.vtk";
  const auto error_with = [&](const std::string& name) {
    mesh.arrays.back().name = name;
    return error_of([&] { write_mesh(path, mesh); });
  };
  EXPECT_EQ(error_with(std::string(256, 'x')),
            "cannot write '" + path + "': the array '" + std::string(200, 'x') +
                "...' has a name that takes 256 bytes, and legacy VTK has 255 at most");
  EXPECT_EQ(error_with(std::string(86, '%')), "cannot write '" + path + "': the array '" + std::string(86, '%') +
                                                  "' has a name that takes 258 bytes, and legacy VTK has 255 at most");
  EXPECT_EQ(folder.names(), Names{});
  EXPECT_EQ(error_with(std::string(255, 'x')), "no error");
}

/// HDF5 2.0 reads no chunks whose shape is in more bytes than the greatest of its numbers takes.
TEST_F(WriteAndRead, Hdf5ChunksHaveTheirShapeInFewBytes) {
  const auto layout = [](const std::vector<unsigned>& bytes) { return std::string(bytes.begin(), bytes.end()); };
  const auto expect = [&](int n, const std::string& of_points, const std::string& of_field) {
    write_mesh(folder / "mesh.vtkhdf", make_grid(n));
    const std::string content = content_of(folder / "mesh.vtkhdf");
    EXPECT_NE(content.find(of_points), std::string::npos) << n;
    EXPECT_NE(content.find(of_field), std::string::npos) << n;
  };
  // Version 4, chunked, no flags, how many numbers, bytes of each, the numbers, of which the size of a value comes
  // last.
  expect(12, layout({4, 2, 0, 3, 2, 0xc0, 6, 3, 0, 4, 0, 3}), layout({4, 2, 0, 2, 2, 0xc0, 6, 4, 0, 3}));
  expect(41, layout({4, 2, 0, 3, 2, 0x55, 0x55, 3, 0, 4, 0, 3}), layout({4, 2, 0, 2, 3, 0, 0, 1, 4, 0, 0, 3}));
}

TEST_F(WriteMesh, RefusesPlacesWhereNoFileCanBe) {
  const std::string path = folder / "none/mesh.vtu";
  EXPECT_EQ(error_of([&] { write_mesh(path, make_grid(2)); }),
            "cannot write '" + path + "': No such file or directory");
  const std::string directory = folder / "directory.vtu";
  std::filesystem::create_directory(directory);
  EXPECT_EQ(error_of([&] { write_mesh(directory, make_grid(2)); }),
            "cannot write '" + directory + "': it is a directory");
  EXPECT_EQ(folder.names(), Names{"directory.vtu"});
}

/// While it lives no file may grow past `bytes`: what a full disk looks like to a writer.
class FullDisk {
 public:
  explicit FullDisk(rlim_t bytes) : signal_(std::signal(SIGXFSZ, SIG_IGN)) {
    getrlimit(RLIMIT_FSIZE, &before_);
    const rlimit limit{bytes, before_.rlim_max};
    setrlimit(RLIMIT_FSIZE, &limit);
  }
  ~FullDisk() {
    setrlimit(RLIMIT_FSIZE, &before_);
    std::signal(SIGXFSZ, signal_);
  }
  FullDisk(const FullDisk&) = delete;
  FullDisk& operator=(const FullDisk&) = delete;

 private:
  rlimit before_{};
  void (*signal_)(int);
};

/// A file of `path` cut short anywhere is an error, leaves what was there, and no other file.
void expect_all_or_nothing(const test::Folder& folder, const std::string& name, const std::function<void()>& write) {
  write();
  const auto size = std::filesystem::file_size(folder / name);
  folder.put(name, "old");
  const std::string expected = "cannot write '" + folder / name + "': File too large";
  for (const std::uintmax_t bytes : {std::uintmax_t(10), size / 2, size - 1}) {
    std::string message;
    {
      const FullDisk full(bytes);
      message = error_of(write);
    }
    EXPECT_EQ(message, expected) << bytes << " of " << size;
    EXPECT_EQ(content_of(folder / name), "old");
    EXPECT_EQ(folder.names(), Names{name});
  }
}

TEST_F(WriteMesh, LeavesNoHalfFileOnAFullDisk) {
  const Dataset mesh = make_grid(12);
  expect_all_or_nothing(folder, "mesh.vtu", [&] { write_mesh(folder / "mesh.vtu", mesh); });
}

/// What is appended in several blocks is read from these to where it stays, and base64 as all other files are.
TEST_F(WriteAndRead, ManyBlocksComeBackAsBase64Does) {
  const auto both = [&](const Dataset& mesh, const auto& use) {
    for (const Encoding encoding : {Encoding::appended, Encoding::base64}) {
      AtomicFile file(folder / "mesh.vtu", encoding);
      detail::write_xml(file, detail::content_of(mesh, {}, mesh.cell_arrays));  // whatever its corners are
      file.commit();
      use(encoding, folder / "mesh.vtu");
    }
  };
  for (const Dataset& mesh : {make_grid(20), with_double_points(make_grid(20)), make_plane(160)}) {
    both(mesh, [&](Encoding, const std::string& path) { test::expect_same(read(path), mesh); });
    std::int32_t& corner = (mesh.dimension() == 3 ? mesh.tetrahedra.data() : mesh.triangles.data())[100000];
    const int wrong = mesh.dimension() == 3 ? static_cast<int>(test::point_count_of(mesh)) : -1;
    corner = wrong;
    std::string messages[2];
    both(mesh, [&](Encoding encoding, const std::string& path) {
      messages[encoding == Encoding::base64] = error_of([&] { read(path); });
    });
    EXPECT_EQ(messages[0], messages[1]);
    EXPECT_NE(messages[0].find(std::to_string(wrong)), std::string::npos) << messages[0];
  }
}

/// Holds without VTK's compression, too.
TEST_F(WriteMesh, InBase64IsXmlThatComesBackAsItWas) {
  const Dataset mesh = grid_with_every_type(5);
  {
    AtomicFile file(folder / "mesh.vtu", Encoding::base64);
    write_mesh(file, mesh);
    file.commit();
  }
  const std::string content = content_of(folder / "mesh.vtu");
  EXPECT_TRUE(std::all_of(content.begin(), content.end(), [](char c) { return c == '\n' || (c >= ' ' && c <= '~'); }));
#ifdef GALE_ENABLE_VTK
  test::expect_same(read(folder / "mesh.vtu"), mesh);
#endif
}

TEST_F(WriteMesh, LeavesNoHalfLegacyFileOnAFullDisk) {
  const Dataset mesh = make_grid(12);
  expect_all_or_nothing(folder, "mesh.vtk", [&] { write_mesh(folder / "mesh.vtk", mesh); });
}

TEST_F(WritePoints, LeavesNoHalfFileOnAFullDisk) {
  expect_all_or_nothing(folder, "points.vtp", [&] { write_points(folder / "points.vtp", three_points()); });
}

}  // namespace
}  // namespace gale::io
