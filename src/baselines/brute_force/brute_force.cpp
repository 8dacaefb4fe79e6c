#include <algorithm>
#include <array>
#include <numeric>

#include <gale/baselines/oracle.hpp>

namespace gale::baselines {

namespace {

using Simplex = std::array<Id, 4>;  ///< vertices ascending, the rest no_id

/// Lists of ids, one after the other.
struct Lists {
  std::vector<std::size_t> begin;
  std::vector<Id> ids;

  std::pair<const Id*, const Id*> operator[](Id i) const { return {ids.data() + begin[i], ids.data() + begin[i + 1]}; }
};

/// Calls visit(face) for each face of dimension `dimension` of a simplex that has `vertices` vertices.
template <class Visit>
void for_each_face(const Simplex& simplex, int vertices, int dimension, const Visit& visit) {
  for (int subset = 0; subset < 1 << vertices; ++subset) {
    Simplex face;
    face.fill(no_id);
    int count = 0;
    for (int corner = 0; corner < vertices; ++corner) {
      if (subset >> corner & 1) face[count++] = simplex[corner];
    }
    if (count == dimension + 1) visit(face);
  }
}

/// All simplices of one dimension of the tetrahedra, in order.
std::vector<Simplex> simplices_of(const std::vector<Simplex>& tetrahedra, Id vertices, int dimension) {
  if (dimension == 3) return tetrahedra;
  std::vector<Simplex> simplices;
  if (dimension == 0) {
    for (Id v = 0; v < vertices; ++v) simplices.push_back({v, no_id, no_id, no_id});
    return simplices;
  }
  for (const Simplex& tetrahedron : tetrahedra) {
    for_each_face(tetrahedron, 4, dimension, [&](const Simplex& face) { simplices.push_back(face); });
  }
  std::sort(simplices.begin(), simplices.end());
  simplices.erase(std::unique(simplices.begin(), simplices.end()), simplices.end());
  return simplices;
}

/// For each of `high`, which of `low` are its faces.
Lists faces_of(const std::vector<Simplex>& high, int high_dimension, const std::vector<Simplex>& low,
               int low_dimension) {
  Lists lists;
  lists.begin = {0};
  for (const Simplex& simplex : high) {
    for_each_face(simplex, high_dimension + 1, low_dimension, [&](const Simplex& face) {
      lists.ids.push_back(static_cast<Id>(std::lower_bound(low.begin(), low.end(), face) - low.begin()));
    });
    std::sort(lists.ids.begin() + static_cast<std::ptrdiff_t>(lists.begin.back()), lists.ids.end());
    lists.begin.push_back(lists.ids.size());
  }
  return lists;
}

/// For each of `columns` ids, the lists that have it.
Lists transposed(const Lists& lists, std::size_t columns) {
  Lists result;
  result.begin.assign(columns + 1, 0);
  for (const Id id : lists.ids) ++result.begin[id + 1];
  std::partial_sum(result.begin.begin(), result.begin.end(), result.begin.begin());
  result.ids.resize(lists.ids.size());
  std::vector<std::size_t> next(result.begin.begin(), result.begin.end() - 1);
  for (std::size_t row = 0; row + 1 < lists.begin.size(); ++row) {
    for (std::size_t i = lists.begin[row]; i < lists.begin[row + 1]; ++i)
      result.ids[next[lists.ids[i]]++] = static_cast<Id>(row);
  }
  return result;
}

class BruteForce : public Oracle {
 public:
  BruteForce(const Mesh& mesh, Relation relation) : adjacency_(adjacency_relations.has(relation)) {
    std::vector<Simplex> tetrahedra(mesh.tetrahedra());
    const auto& of_mesh = mesh.encoded().tetrahedra;
    for (Id t = 0; t < mesh.tetrahedra(); ++t)
      tetrahedra[t] = {of_mesh(t, 0), of_mesh(t, 1), of_mesh(t, 2), of_mesh(t, 3)};
    const int rows = row_dimension(relation), entries = entry_dimension(relation);
    // Two vertices share an edge, other neighbours a face.
    const int between = !adjacency_ ? entries : rows == 0 ? 1 : rows - 1;
    const int low = std::min(rows, between), high = std::max(rows, between);
    const auto lows = simplices_of(tetrahedra, mesh.vertices(), low),
               highs = simplices_of(tetrahedra, mesh.vertices(), high);
    const Lists down = faces_of(highs, high, lows, low);
    const Lists up = transposed(down, lows.size());
    there_ = rows > between ? down : up;
    if (adjacency_) back_ = rows > between ? up : down;
  }

  std::string name() const override { return "brute force"; }
  Id rows() const override { return static_cast<Id>(there_.begin.size()) - 1; }

  void read(Id simplex, int, std::vector<Id>& row) override {
    row.clear();
    const auto [begin, end] = there_[simplex];
    if (!adjacency_) {
      row.assign(begin, end);
      return;
    }
    for (const Id* between = begin; between < end; ++between) {
      const auto [first, last] = back_[*between];
      std::copy_if(first, last, std::back_inserter(row), [simplex](Id other) { return other != simplex; });
    }
    std::sort(row.begin(), row.end());
    row.erase(std::unique(row.begin(), row.end()), row.end());
  }

 private:
  bool adjacency_;
  Lists there_;  ///< from the rows' simplices to the entries, or to what neighbours share
  Lists back_;   ///< of adjacency relations: from what neighbours share back to the rows' simplices
};

}  // namespace

std::unique_ptr<Oracle> make_brute_force(const Mesh& mesh, Relation relation) {
  return std::make_unique<BruteForce>(mesh, relation);
}

}  // namespace gale::baselines
