#include "distributed/given_parts.hpp"

#include <algorithm>
#include <map>
#include <random>
#include <set>

#include "support/arrays.hpp"
#include "support/surfaces.hpp"

namespace gale::test {

namespace {

/// Each of `count` on any rank: those on this one.
std::vector<Id> random_share(Id count, int rank, int ranks, std::mt19937& random) {
  std::vector<Id> mine;
  for (Id i = 0; i < count; ++i) {
    if (static_cast<int>(random() % ranks) == rank) mine.push_back(i);
  }
  return mine;
}

GivenPart random_part(const InputMesh& input, int rank, int ranks) {
  std::mt19937 random(31);
  GivenPart part;
  for (const Id v : random_share(input.vertices(), rank, ranks, random)) part.add_vertex(input, v);
  std::vector<Id> cells = random_share(static_cast<Id>(input.tetrahedra.size()), rank, ranks, random);
  std::shuffle(cells.begin(), cells.end(), random);
  for (const Id t : cells) part.add_cell(input, t);
  return part;
}

/// An interval of vertices, and cells anywhere, in order.
GivenPart interval_part(const InputMesh& input, std::pair<Id, Id> vertices, int rank, int ranks) {
  std::mt19937 random(37);
  GivenPart part;
  for (Id v = vertices.first; v < vertices.second; ++v) part.add_vertex(input, v);
  for (const Id t : random_share(static_cast<Id>(input.tetrahedra.size()), rank, ranks, random))
    part.add_cell(input, t);
  return part;
}

/// Intervals that share a part with the next.
std::pair<Id, Id> overlapping(Id count, int rank, int ranks) {
  const Id begin = static_cast<Id>(Offset(count) * rank / ranks),
           end = static_cast<Id>(Offset(count) * (rank + 1) / ranks);
  return {std::max(begin - count / 7, 0), std::min(end + count / 5, count)};
}

/// The middle on the first rank, all on the last, so that it owns both sides; nothing between.
std::pair<Id, Id> island(Id count, int rank, int ranks) {
  if (rank == ranks - 1) return {0, count};
  return rank == 0 ? std::make_pair(count / 3, 2 * count / 3) : std::make_pair(0, 0);
}

GivenPart block(const InputMesh& input, int rank, int ranks) {
  const auto count = static_cast<Offset>(input.tetrahedra.size());
  GivenPart part;
  std::set<Id> touched, all_touched;
  for (const auto& quad : input.tetrahedra) all_touched.insert(quad.begin(), quad.end());
  for (Offset t = count * rank / ranks; t < count * (rank + 1) / ranks; ++t) {
    part.add_cell(input, static_cast<Id>(t));
    touched.insert(input.tetrahedra[t].begin(), input.tetrahedra[t].end());
  }
  for (Id v = 0; v < input.vertices(); ++v) {
    if (touched.count(v) != 0 || (rank == ranks - 1 && all_touched.count(v) == 0)) part.add_vertex(input, v);
  }
  return part;
}

}  // namespace

void GivenPart::add_vertex(const InputMesh& input, Id vertex) {
  vertices.push_back(vertex);
  vertex_ids.push_back(vertex_name(vertex));
  points.insert(points.end(), input.points[vertex].begin(), input.points[vertex].end());
}

void GivenPart::add_cell(const InputMesh& input, Id cell) {
  const auto& vertices = input.tetrahedra[cell];
  corners = vertices[2] == vertices[3] ? 3 : 4;
  cell_ids.push_back(cell_name(cell));
  for (int corner = 0; corner < corners; ++corner) cells.push_back(vertex_name(vertices[corner]));
}

MeshPart<GlobalId> GivenPart::views() const {
  const CellRows<GlobalId> rows(cells.data(), cells.size() / corners, corners);
  return make_part(view_of(vertex_ids), detail::view_of<3>("points", points), rows, view_of(cell_ids));
}

const std::vector<std::string>& input_names() {
  static const std::vector<std::string> names = [] {
    std::vector<std::string> all = mesh_names();
    all.insert(all.end(), {"torus", "any triangles", "vertices without a triangle"});
    return all;
  }();
  return names;
}

const InputMesh& input_named(const std::string& name) {
  static std::map<std::string, InputMesh> made;
  const auto surface = surfaces().find(name);
  if (surface == surfaces().end()) return mesh_named(name);
  const auto [mesh, is_new] = made.try_emplace(name, InputMesh{surface->second.points, {}});
  for (const auto& [a, b, c] : is_new ? surface->second.triangles : std::vector<std::array<Id, 3>>())
    mesh->second.tetrahedra.push_back({a, b, c, c});
  return mesh->second;
}

const std::vector<std::string>& partition_names() {
  static const std::vector<std::string> names = {"random", "blocks", "last", "shared", "curve", "overlap", "island"};
  return names;
}

GivenPart part_of(const InputMesh& input, const std::string& partition, const Communicator& ranks) {
  const int rank = ranks.rank(), size = ranks.size();
  const bool is_overlap = partition == "overlap", is_island = partition == "island";
  vertex_names = is_overlap || is_island ? names_without_gaps : names_with_gaps;
  if (is_overlap) return interval_part(input, overlapping(input.vertices(), rank, size), rank, size);
  if (is_island) return interval_part(input, island(input.vertices(), rank, size), rank == 0 ? 0 : 1, 1);
  if (partition == "blocks") return block(input, rank, size);
  GivenPart part;
  if (partition == "last") return rank == size - 1 ? random_part(input, 0, 1) : part;
  part = random_part(input, rank, size);
  if (partition != "shared") return part;
  part.vertices.clear();
  part.vertex_ids.clear();
  part.points.clear();
  for (Id v = input.vertices(); v-- > 0;) part.add_vertex(input, v);
  return part;
}

PartitionOptions options_of(const std::string& partition) {
  PartitionOptions options;
  options.repartition = partition == "curve";
  options.capacity = 20;
  return options;
}

DistributedMesh distribute(const Communicator& ranks, const GivenPart& part, const std::string& partition) {
  return DistributedMesh(ranks, part.views(), options_of(partition));
}

}  // namespace gale::test
