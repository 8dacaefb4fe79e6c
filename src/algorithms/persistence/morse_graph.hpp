#pragma once

#include <cstdint>
#include <queue>
#include <vector>

#include <gale/algorithms/morse_smale.hpp>

namespace gale::detail {

/// The graph of critical simplices (nodes) and the paths between them (arcs), in which pairs of nodes are cancelled.
class MorseGraph {
 public:
  /// A path between a node and one that is a dimension higher. It is a path of the complex, or joins three other arcs:
  /// `start`, then `middle` backwards, then `end`.
  struct Arc {
    int low, high;
    bool is_only;  ///< false if it stands for several paths
    bool is_alive = true;
    Id separatrix = no_id;  ///< place in the complex's separatrices of its kind
    int start = -1, middle = -1, end = -1;
  };

  static constexpr int nowhere = -1;

  /// Pairs of a persistence below `threshold` may be cancelled.
  MorseGraph(const MorseSmaleComplex& complex, const std::vector<double>& values, double threshold);

  /// Cancels these pairs, the least persistent first.
  void cancel();

  int nodes() const { return static_cast<int>(dimension_.size()); }
  int node(int dimension, Id place) const { return first_[dimension] + place; }
  int dimension(int node) const { return dimension_[node]; }
  Id place(int node) const { return node - first_[dimension_[node]]; }
  bool is_alive(int node) const { return is_alive_[node]; }
  const std::vector<Arc>& arcs() const { return arcs_; }

  /// The node whose manifold the manifold of a minimum or a maximum became part of; `nowhere` if it became part of
  /// none, because its paths now leave through the surface.
  int heir(int node);

  /// The nodes whose walls became part of a saddle's wall, without those that had become part of theirs.
  const std::vector<int>& joined(int node) const { return joined_[node]; }

 private:
  struct Pair {
    double persistence;
    int low, high, arc;

    bool operator>(const Pair& other) const;
  };

  template <class Cell>
  void add(const Separatrices<Cell>& separatrices, int from_dimension, int to_dimension);
  int add(const Arc& arc);
  void cancel(int arc);
  bool may_cancel(int arc) const;
  std::vector<int> others(const std::vector<int>& arcs, int but) const;
  static constexpr std::size_t most_new_paths = 1024;

  std::vector<double> values_;
  double threshold_;
  int first_[5];
  std::vector<signed char> dimension_;
  std::vector<char> is_alive_;
  std::vector<int> heir_;
  std::vector<std::vector<int>> up_, down_;  ///< arcs of each node that is alive, dead ones among them
  std::vector<std::vector<int>> joined_;
  std::vector<Arc> arcs_;
  std::priority_queue<Pair, std::vector<Pair>, std::greater<Pair>> pairs_;
};

}  // namespace gale::detail
