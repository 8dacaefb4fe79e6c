#include <cstring>
#include <string>
#include <variant>
#include <vector>

#include <gale/base/error.hpp>
#include <gale/base/sort.hpp>
#include <gale/mesh/exchange/entries_by_rank.hpp>
#include <gale/mesh/exchange/messages.hpp>
#include <gale/outputs/field.hpp>

namespace gale::outputs {

namespace {

/// A vertex with its place in an order, and its value's bits.
struct PlacedValue {
  GlobalId place, vertex;
  std::int64_t bits;

  double value() const {
    double value;
    std::memcpy(&value, &bits, sizeof(value));
    return value;
  }
};

/// What is wrong with an array that is no permutation.
std::string no_permutation(const Mesh& mesh, const io::PointArray& order) {
  return "array '" + order.name + "' is no permutation of 0 to " + std::to_string(mesh.all_vertices() - 1) + ": ";
}

/// The owned vertices with their places and values. Throws gale::Error for one whose place is none.
std::vector<PlacedValue> placed_values(const Mesh& mesh, const io::PointArray& order, const io::PointArray& field) {
  const OtherIds input = mesh.vertices_in_input();
  std::vector<PlacedValue> placed;
  for (const Id v : mesh.owned_vertices()) {
    const Id vertex = input[v];
    const double place = value_at(order, vertex), value = value_at(field, vertex);
    const bool is_place = place >= 0 && place < static_cast<double>(mesh.all_vertices()) &&
                          place == static_cast<double>(static_cast<GlobalId>(place));
    if (!is_place) {
      const auto text = [vertex](const auto& values) { return std::to_string(values[vertex]); };
      throw Error(no_permutation(mesh, order) + "vertex " + std::to_string(mesh.vertex_id(vertex)) + " has " +
                  std::visit(text, order.values));
    }
    std::int64_t bits;
    std::memcpy(&bits, &value, sizeof(bits));
    placed.push_back({static_cast<GlobalId>(place), mesh.vertex_id(vertex), bits});
  }
  return placed;
}

/// The vertices of as many places, that follow one another, for each rank; in order. Collective.
std::vector<PlacedValue> share_of_places(const Mesh& mesh, const io::PointArray& order, const io::PointArray& field) {
  const Ranks& ranks = mesh.exchange().ranks();
  const GlobalId at_once = mesh.all_vertices() / ranks.size() + 1;
  std::vector<PlacedValue> placed;
  gale::detail::together(ranks, [&] { placed = placed_values(mesh, order, field); });
  const auto sent = gale::detail::collect_by_rank<PlacedValue>(
      ranks, "GALE::placed_values", static_cast<Offset>(placed.size()),
      [&](Id i) { return static_cast<int>(placed[i].place / at_once); }, [&](Id i) { return placed[i]; });
  const auto received = gale::detail::exchange_packed(ranks, "GALE::received_values", sent);
  gale::detail::together(ranks, [&] {
    placed.assign(received.entries.data(), received.entries.data() + received.count());
    parallel_sort("GALE::sort_placed", placed.begin(), placed.end(),
                  [](const auto& a, const auto& b) { return a.place < b.place; });
  });
  return placed;
}

/// Throws SharedError unless all places are there. Collective.
void require_all_places(const Mesh& mesh, const io::PointArray& order, const std::vector<PlacedValue>& placed) {
  std::int64_t different = 0;
  for (std::size_t i = 0; i < placed.size(); ++i) different += i == 0 || placed[i].place != placed[i - 1].place;
  different = mesh.exchange().ranks().sum(different);
  if (different < mesh.all_vertices())
    throw SharedError(no_permutation(mesh, order) + "it has " + std::to_string(different) + " different values");
}

}  // namespace

std::string note_of_order(const Mesh& mesh, const io::PointArray& order, const io::PointArray& field) {
  const Ranks& ranks = mesh.exchange().ranks();
  const std::vector<PlacedValue> placed = share_of_places(mesh, order, field);
  require_all_places(mesh, order, placed);
  // The one before a rank's first: places are on the first ranks, so that no rank between has none.
  PlacedValue before = placed.empty() ? PlacedValue() : placed.back();
  const std::vector<std::int64_t> vertices = ranks.all(before.vertex), bits = ranks.all(before.bits);
  if (ranks.rank() > 0) before = {0, vertices[ranks.rank() - 1], bits[ranks.rank() - 1]};
  if (ranks.rank() == 0 && !placed.empty()) before = placed.front();
  std::string found;
  for (const PlacedValue& one : placed) {
    if (found.empty() && one.value() < before.value()) found = contradiction(field.name, one.vertex, before.vertex);
    before = one;
  }
  const std::int64_t first = ranks.least(std::int64_t(found.empty() ? ranks.size() : ranks.rank()));
  return first == ranks.size() ? "" : ranks.broadcast(found, static_cast<int>(first));
}

}  // namespace gale::outputs
