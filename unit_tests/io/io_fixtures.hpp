#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <functional>
#include <limits>
#include <random>
#include <set>
#include <sstream>
#include <string>
#include <variant>
#include <vector>

#include <gtest/gtest.h>

#include <gale/base/error.hpp>
#include <gale/io/dataset.hpp>
#include <gale/io/formats.hpp>

namespace gale::io::test {

/// An empty directory that goes when the test does.
class Folder {
 public:
  Folder() {
    std::random_device random;
    std::ostringstream name;
    name << "gale_io_" << std::hex << random() << random();
    path_ = std::filesystem::temp_directory_path() / name.str();
    std::filesystem::create_directory(path_);
  }
  ~Folder() { std::filesystem::remove_all(path_); }
  Folder(const Folder&) = delete;
  Folder& operator=(const Folder&) = delete;

  std::string operator/(const std::string& name) const { return (path_ / name).string(); }

  /// Writes `content` to the file `name` and returns its path.
  std::string put(const std::string& name, const std::string& content) const {
    std::ofstream(*this / name, std::ios::binary) << content;
    return *this / name;
  }

  std::set<std::string> names() const {
    std::set<std::string> all;
    for (const auto& entry : std::filesystem::directory_iterator(path_)) all.insert(entry.path().filename().string());
    return all;
  }

 private:
  std::filesystem::path path_;
};

inline std::string content_of(const std::string& path) {
  std::ostringstream content;
  content << std::ifstream(path, std::ios::binary).rdbuf();
  return content.str();
}

/// The message of the `Error` that `run` throws. Nothing may be printed meanwhile, and it is one line.
inline std::string error_of(const std::function<void()>& run) {
  std::string message = "no error";
  testing::internal::CaptureStdout();
  testing::internal::CaptureStderr();
  try {
    run();
  } catch (const Error& error) {
    message = error.what();
  }
  EXPECT_EQ(testing::internal::GetCapturedStdout(), "");
  EXPECT_EQ(testing::internal::GetCapturedStderr(), "");
  EXPECT_EQ(message.find('\n'), std::string::npos) << message;
  return message;
}

class FileTest : public testing::Test {
 protected:
  Folder folder;
};

/// Tests that files are read in: skipped where this GALE has no VTK.
class VtkTest : public FileTest {
 protected:
  void SetUp() override {
    if (!detail::reads_files()) GTEST_SKIP() << "built without VTK";
  }
};

inline std::size_t point_count_of(const Dataset& mesh) {
  return std::visit([](const auto& p) { return p.extent(0); }, mesh.points);
}

inline std::vector<double> points_of(const Dataset& mesh) {
  std::vector<double> xyz;
  const auto append = [&](const auto& points) {
    for (std::size_t i = 0; i < points.extent(0); ++i) {
      for (int d = 0; d < 3; ++d) xyz.push_back(points(i, d));
    }
  };
  std::visit(append, mesh.points);
  return xyz;
}

inline std::vector<int> tetrahedra_of(const Dataset& mesh) {
  std::vector<int> ids;
  for (std::size_t t = 0; t < mesh.tetrahedra.extent(0); ++t) {
    for (int k = 0; k < 4; ++k) ids.push_back(mesh.tetrahedra(t, k));
  }
  return ids;
}

inline std::vector<int> triangles_of(const Dataset& mesh) {
  std::vector<int> ids;
  for (std::size_t t = 0; t < mesh.triangles.extent(0); ++t) {
    for (int k = 0; k < 3; ++k) ids.push_back(mesh.triangles(t, k));
  }
  return ids;
}

/// The tetrahedron's volume, negative where its orientation is.
inline double volume(const Dataset& mesh, std::size_t t) {
  const std::vector<double> xyz = points_of(mesh);
  double e[3][3];
  for (int k = 0; k < 3; ++k) {
    for (int d = 0; d < 3; ++d) {
      e[k][d] = xyz[3 * mesh.tetrahedra(t, k + 1) + d] - xyz[3 * mesh.tetrahedra(t, 0) + d];
    }
  }
  return (e[0][0] * (e[1][1] * e[2][2] - e[1][2] * e[2][1]) - e[0][1] * (e[1][0] * e[2][2] - e[1][2] * e[2][0]) +
          e[0][2] * (e[1][0] * e[2][1] - e[1][1] * e[2][0])) /
         6;
}

template <class T>
const std::vector<T>& values_of(const PointArray& array) {
  return std::get<std::vector<T>>(array.values);
}

inline std::vector<std::string> names_of(const std::vector<PointArray>& arrays) {
  std::vector<std::string> names;
  for (const PointArray& array : arrays) names.push_back(array.name);
  return names;
}

inline void expect_same(const std::vector<PointArray>& a, const std::vector<PointArray>& b) {
  ASSERT_EQ(names_of(a), names_of(b));
  for (std::size_t k = 0; k < a.size(); ++k) {
    EXPECT_EQ(a[k].components, b[k].components) << a[k].name;
    EXPECT_EQ(a[k].values.index(), b[k].values.index()) << a[k].name;
    EXPECT_TRUE(a[k].values == b[k].values) << a[k].name;
  }
}

inline void expect_same(const Dataset& a, const Dataset& b) {
  EXPECT_EQ(a.points.index(), b.points.index());
  EXPECT_EQ(points_of(a), points_of(b));
  EXPECT_EQ(tetrahedra_of(a), tetrahedra_of(b));
  EXPECT_EQ(triangles_of(a), triangles_of(b));
  expect_same(a.arrays, b.arrays);
}

/// One array of every type, with its extreme values among the first of `points`, and one of three components.
inline std::vector<PointArray> arrays_of_every_type(std::size_t points) {
  std::vector<PointArray> arrays;
  const auto add = [&](const std::string& name, auto example) {
    using T = decltype(example);
    std::vector<T> values(points);
    for (std::size_t i = 0; i < points; ++i) values[i] = static_cast<T>(i);
    values[0] = std::numeric_limits<T>::lowest();
    values[1] = std::numeric_limits<T>::max();
    arrays.push_back({name, 1, values});
  };
  add("int8", std::int8_t());
  add("uint8", std::uint8_t());
  add("int16", std::int16_t());
  add("uint16", std::uint16_t());
  add("int32", std::int32_t());
  add("uint32", std::uint32_t());
  add("int64", std::int64_t());
  add("uint64", std::uint64_t());
  add("float", float());
  add("double", double());
  std::vector<float> triples(3 * points);
  for (std::size_t i = 0; i < triples.size(); ++i) triples[i] = 0.5f * static_cast<float>(i);
  arrays.push_back({"triple with spaces", 3, triples});
  return arrays;
}

}  // namespace gale::io::test
