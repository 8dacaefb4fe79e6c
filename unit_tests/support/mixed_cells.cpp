#include "support/mixed_cells.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

namespace gale::test {

namespace {

using Ids = std::vector<std::int64_t>;

/// Two equal polygons, one above the other, and what is between them.
std::vector<Ids> faces_of_prism(const Ids& bottom, const Ids& top) {
  std::vector<Ids> faces = {bottom, top};
  for (std::size_t k = 0; k < bottom.size(); ++k) {
    const std::size_t next = (k + 1) % bottom.size();
    faces.push_back({bottom[k], bottom[next], top[next], top[k]});
  }
  return faces;
}

class MixedMaker {
 public:
  MixedMaker(int side, int height, std::uint32_t seed) : random_(seed), side_(side), height_(height) {
    for (int z = 0; z <= height; ++z) {
      for (int y = 0; y <= side; ++y) {
        for (int x = 0; x <= side; ++x) add_point(x, y, z);
      }
    }
  }

  /// No two cells have more than one face in common: three of their vertices in a row would be in both of their fans.
  MixedMesh make() {
    for (int y = 0; y < side_; ++y) {
      for (int x = 0; x < side_;) {
        const bool is_two = x + 1 < side_ && (x + y) % 2 == 0 && one_in(2);
        x += is_two ? add_two_columns(x, y) : add_column(x, y);
      }
    }
    std::shuffle(mesh_.cells.begin(), mesh_.cells.end(), random_);
    mesh_.volume = 0.75 * side_ * side_ * height_;
    mesh_.renumber(random_);
    return std::move(mesh_);
  }

 private:
  using Corner = std::pair<int, int>;

  bool one_in(int n) { return random_() % n == 0; }

  std::int64_t add_point(double x, double y, double z) {
    mesh_.points.push_back({x + 0.5 * z, 0.5 * x + y + 0.25 * z, 0.75 * z});
    return static_cast<std::int64_t>(mesh_.points.size()) - 1;
  }

  Ids at(const std::vector<Corner>& corners, int z) const {
    Ids ids;
    for (const auto& [x, y] : corners) ids.push_back((z * (side_ + 1) + y) * (side_ + 1) + x);
    return ids;
  }

  int add_column(int x, int y) {
    const std::vector<Corner> c = {{x, y}, {x + 1, y}, {x + 1, y + 1}, {x, y + 1}};
    if (one_in(3)) {
      const int turn = one_in(2) ? 1 : 0;
      add_prisms({c[turn], c[turn + 1], c[turn + 2]});
      add_prisms({c[turn], c[turn + 2], c[(turn + 3) % 4]});
    } else {
      add_prisms(c);
    }
    return 1;
  }

  int add_two_columns(int x, int y) {
    if (one_in(2)) {
      add_prisms({{x, y}, {x + 1, y}, {x + 2, y}, {x + 2, y + 1}, {x + 1, y + 1}, {x, y + 1}});
    } else {
      add_prisms({{x, y}, {x + 1, y}, {x + 2, y}, {x + 1, y + 1}, {x, y + 1}});
      add_prisms({{x + 2, y}, {x + 2, y + 1}, {x + 1, y + 1}});
    }
    return 2;
  }

  void add_prisms(std::vector<Corner> corners) {
    const auto turn = static_cast<std::ptrdiff_t>(random_() % corners.size());
    std::rotate(corners.begin(), corners.begin() + turn, corners.end());
    for (int z = 0; z < height_; ++z) add_prism(at(corners, z), at(corners, z + 1));
  }

  void add_prism(const Ids& bottom, const Ids& top) {
    const std::vector<Ids> faces = faces_of_prism(bottom, top);
    Ids points = bottom;
    points.insert(points.end(), top.begin(), top.end());
    if (one_in(3)) return add_polyhedron(faces);
    if (bottom.size() != 4)
      return mesh_.cells.push_back({std::array<int, 7>{0, 0, 0, 13, 0, 15, 16}[bottom.size()], points, faces});
    if (one_in(2)) return mesh_.cells.push_back({12, points, faces});
    if (one_in(2)) {
      mesh_.cells.push_back({11, {bottom[0], bottom[1], bottom[3], bottom[2], top[0], top[1], top[3], top[2]}, faces});
      return;
    }
    add_pyramids(faces);
  }

  /// The faces in any order, each from any corner on, either way around.
  void add_polyhedron(std::vector<Ids> faces) {
    std::shuffle(faces.begin(), faces.end(), random_);
    MixedCell cell{42, {static_cast<std::int64_t>(faces.size())}, {}};
    for (Ids& face : faces) {
      std::rotate(face.begin(), face.begin() + static_cast<std::ptrdiff_t>(random_() % face.size()), face.end());
      if (one_in(2)) std::reverse(face.begin(), face.end());
      cell.points.push_back(static_cast<std::int64_t>(face.size()));
      cell.points.insert(cell.points.end(), face.begin(), face.end());
    }
    cell.faces = std::move(faces);
    mesh_.cells.push_back(std::move(cell));
  }

  void add_pyramids(const std::vector<Ids>& faces) {
    std::array<double, 3> middle{};
    for (std::size_t face = 0; face < 2; ++face) {
      for (const std::int64_t point : faces[face]) {
        for (int axis = 0; axis < 3; ++axis) middle[axis] += mesh_.points[point][axis] / 8;
      }
    }
    const auto tip = static_cast<std::int64_t>(mesh_.points.size());
    mesh_.points.push_back(middle);
    for (Ids face : faces) {
      MixedCell cell{14, face, {face}};
      cell.points.push_back(tip);
      for (std::size_t k = 0; k < 4; ++k) cell.faces.push_back({face[k], face[(k + 1) % 4], tip});
      mesh_.cells.push_back(std::move(cell));
    }
  }

  std::mt19937 random_;
  int side_, height_;
  MixedMesh mesh_;
};

}  // namespace

std::vector<std::int64_t> MixedMesh::connectivity() const {
  Ids all;
  for (const MixedCell& cell : cells) all.insert(all.end(), cell.points.begin(), cell.points.end());
  return all;
}

std::vector<std::int64_t> MixedMesh::offsets() const {
  Ids all = {0};
  for (const MixedCell& cell : cells) all.push_back(all.back() + static_cast<std::int64_t>(cell.points.size()));
  return all;
}

std::vector<std::uint8_t> MixedMesh::types() const {
  std::vector<std::uint8_t> all;
  for (const MixedCell& cell : cells) all.push_back(static_cast<std::uint8_t>(cell.type));
  return all;
}

void MixedMesh::renumber(std::mt19937& random) {
  Ids number(points.size());
  std::iota(number.begin(), number.end(), 0);
  std::shuffle(number.begin(), number.end(), random);
  const auto before = points;
  for (std::size_t i = 0; i < before.size(); ++i) points[number[i]] = before[i];
  for (MixedCell& cell : cells) {
    for (Ids& face : cell.faces) {
      for (std::int64_t& point : face) point = number[point];
    }
    if (cell.type != 42) {
      for (std::int64_t& point : cell.points) point = number[point];
      continue;
    }
    for (std::size_t at = 1; at < cell.points.size();) {
      const std::int64_t corners = cell.points[at++];
      for (std::int64_t k = 0; k < corners; ++k, ++at) cell.points[at] = number[cell.points[at]];
    }
  }
}

MixedMesh mixed_mesh(int side, int height, std::uint32_t seed) { return MixedMaker(side, height, seed).make(); }

MixedMesh collapsed_cylinder(int around, int layers, int height, std::uint32_t seed) {
  MixedMesh mesh;
  const auto id = [&](int z, int r, int a) {
    const int in_layer = 1 + layers * around;
    return std::int64_t(z) * in_layer + (r == 0 ? 0 : 1 + (r - 1) * around + a % around);
  };
  const double turn = 2 * std::acos(-1.0) / around;
  for (int z = 0; z <= height; ++z) {
    mesh.points.push_back({0, 0, double(z)});
    for (int r = 1; r <= layers; ++r) {
      for (int a = 0; a < around; ++a)
        mesh.points.push_back({r * std::cos(turn * a), r * std::sin(turn * a), double(z)});
    }
  }
  for (int z = 0; z < height; ++z) {
    for (int r = 0; r < layers; ++r) {
      for (int a = 0; a < around; ++a) {
        const auto ring = [&](int at) {
          return Ids{id(at, r, a), id(at, r + 1, a), id(at, r + 1, a + 1), id(at, r, a + 1)};
        };
        MixedCell cell{12, ring(z), {}};
        const Ids top = ring(z + 1);
        cell.points.insert(cell.points.end(), top.begin(), top.end());
        for (Ids face : faces_of_prism(ring(z), top)) {
          face.erase(std::unique(face.begin(), face.end()), face.end());
          if (face.size() > 1 && face.front() == face.back()) face.pop_back();
          if (face.size() > 2) cell.faces.push_back(face);
        }
        mesh.cells.push_back(std::move(cell));
      }
    }
  }
  std::mt19937 random(seed);
  std::shuffle(mesh.cells.begin(), mesh.cells.end(), random);
  mesh.renumber(random);
  mesh.volume = height * layers * layers * around * std::sin(turn) / 2;
  return mesh;
}

}  // namespace gale::test
