#include "distributed/given_parts.hpp"

#include <algorithm>
#include <random>
#include <set>

#include "support/arrays.hpp"

namespace gale::test {

namespace {

GivenPart random_part(const InputMesh& input, int rank, int ranks) {
  std::mt19937 random(31);
  GivenPart part;
  for (Id v = 0; v < input.vertices(); ++v) {
    if (static_cast<int>(random() % ranks) == rank) part.add_vertex(input, v);
  }
  std::vector<Id> tetrahedra;
  for (Id t = 0; t < static_cast<Id>(input.tetrahedra.size()); ++t) {
    if (static_cast<int>(random() % ranks) == rank) tetrahedra.push_back(t);
  }
  std::shuffle(tetrahedra.begin(), tetrahedra.end(), random);
  for (const Id t : tetrahedra) part.add_tetrahedron(input, t);
  return part;
}

GivenPart block(const InputMesh& input, int rank, int ranks) {
  const auto count = static_cast<Offset>(input.tetrahedra.size());
  GivenPart part;
  std::set<Id> touched, all_touched;
  for (const auto& quad : input.tetrahedra) all_touched.insert(quad.begin(), quad.end());
  for (Offset t = count * rank / ranks; t < count * (rank + 1) / ranks; ++t) {
    part.add_tetrahedron(input, static_cast<Id>(t));
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

void GivenPart::add_tetrahedron(const InputMesh& input, Id tetrahedron) {
  tetrahedron_ids.push_back(tetrahedron_name(tetrahedron));
  for (const Id vertex : input.tetrahedra[tetrahedron]) tetrahedra.push_back(vertex_name(vertex));
}

MeshPart<GlobalId> GivenPart::views() const {
  return make_part(view_of(vertex_ids), detail::view_of<3>("points", points),
                   detail::view_of<4>("tetrahedra", tetrahedra), view_of(tetrahedron_ids));
}

const std::vector<std::string>& partition_names() {
  static const std::vector<std::string> names = {"random", "blocks", "last", "shared", "curve"};
  return names;
}

GivenPart part_of(const InputMesh& input, const std::string& partition, const Communicator& ranks) {
  const int rank = ranks.rank(), size = ranks.size();
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
