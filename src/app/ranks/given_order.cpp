#include <cstring>
#include <string>
#include <variant>
#include <vector>

#include <gale/app/ranks/shared_input.hpp>
#include <gale/base/sort.hpp>
#include <gale/mesh/exchange/entries_by_rank.hpp>
#include <gale/mesh/exchange/messages.hpp>
#include <gale/mesh/exchange/places.hpp>
#include <gale/outputs/field.hpp>

namespace gale::app {

namespace {

/// Throws SharedError if an array isn't a permutation of 0 to n-1. Collective.
void require_permutation(const Mesh& mesh, const io::PointArray& order) {
  const Id* const input = mesh.vertex_input().data();
  const auto count = static_cast<double>(mesh.all_vertices());
  Array<detail::SimplexKey, HostMemory> keys;
  const auto refuse = [&](Id vertex) {
    const auto text = [vertex](const auto& values) { return std::to_string(values[vertex]); };
    throw Error("array '" + order.name + "' is no permutation of 0 to " + std::to_string(mesh.all_vertices() - 1) +
                ": vertex " + std::to_string(mesh.vertex_id(vertex)) + " has " + std::visit(text, order.values));
  };
  detail::together(mesh.exchange().ranks(), [&] {
    keys = allocate<decltype(keys)>("GALE::order_keys", mesh.owned_vertices().size());
    for (const Id v : mesh.owned_vertices()) {
      const double value = outputs::value_at(order, input[v]);
      if (!(value >= 0 && value < count) || value != static_cast<double>(static_cast<GlobalId>(value)))
        refuse(input[v]);
      keys(v - mesh.owned_vertices().first) = {static_cast<GlobalId>(value), 0, 0};
    }
  });
  const auto found = detail::places_of_keys(mesh.exchange().ranks(), keys);
  if (found.count == mesh.all_vertices()) return;
  throw SharedError("array '" + order.name + "' is no permutation of 0 to " + std::to_string(mesh.all_vertices() - 1) +
                    ": it has " + std::to_string(found.count) + " different values");
}

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

/// The owned vertices with their places and values.
std::vector<PlacedValue> placed_values(const Mesh& mesh, const io::PointArray& order, const io::PointArray& field) {
  const OtherIds input = mesh.vertices_in_input();
  std::vector<PlacedValue> placed;
  for (const Id v : mesh.owned_vertices()) {
    const double value = outputs::value_at(field, input[v]);
    std::int64_t bits;
    std::memcpy(&bits, &value, sizeof(bits));
    placed.push_back({static_cast<GlobalId>(outputs::value_at(order, input[v])), mesh.vertex_id(input[v]), bits});
  }
  return placed;
}

/// The note of contradiction_in: each rank looks at as many places, that follow one another. Collective.
std::string contradiction_on_ranks(const Mesh& mesh, const io::PointArray& order, const io::PointArray& field) {
  const Ranks& ranks = mesh.exchange().ranks();
  const GlobalId at_once = mesh.all_vertices() / ranks.size() + 1;
  std::vector<PlacedValue> own;
  detail::together(ranks, [&] { own = placed_values(mesh, order, field); });
  const auto sent = detail::collect_by_rank<PlacedValue>(
      ranks, "GALE::placed_values", static_cast<Offset>(own.size()),
      [&](Id i) { return static_cast<int>(own[i].place / at_once); }, [&](Id i) { return own[i]; });
  const auto received = detail::exchange_packed(ranks, "GALE::received_values", sent);
  std::vector<PlacedValue> placed;
  detail::together(ranks, [&] {
    placed.assign(received.entries.data(), received.entries.data() + received.count());
    parallel_sort("GALE::sort_placed", placed.begin(), placed.end(),
                  [](const auto& a, const auto& b) { return a.place < b.place; });
  });
  // The one before a rank's first: places are on the first ranks, so that no rank between has none.
  const PlacedValue last = placed.empty() ? PlacedValue() : placed.back();
  const std::vector<std::int64_t> vertices = ranks.all(last.vertex), bits = ranks.all(last.bits);
  std::string found;
  detail::together(ranks, [&] {
    if (ranks.rank() > 0) placed.insert(placed.begin(), {0, vertices[ranks.rank() - 1], bits[ranks.rank() - 1]});
    for (std::size_t i = 1; i < placed.size() && found.empty(); ++i) {
      if (placed[i].value() < placed[i - 1].value())
        found = outputs::contradiction(field.name, placed[i].vertex, placed[i - 1].vertex);
    }
  });
  const std::int64_t first = ranks.least(std::int64_t(found.empty() ? ranks.size() : ranks.rank()));
  return first == ranks.size() ? "" : ranks.broadcast(found, static_cast<int>(first));
}

}  // namespace

std::string note_of_order(const Mesh& mesh, const io::PointArray& order, const io::PointArray& field) {
  require_permutation(mesh, order);
  return contradiction_on_ranks(mesh, order, field);
}

}  // namespace gale::app
