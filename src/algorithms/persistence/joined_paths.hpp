#pragma once

#include <array>
#include <cstdint>
#include <unordered_map>
#include <vector>

#include <gale/algorithms/persistence/morse_graph.hpp>

namespace gale::detail {

/// The cells of the paths that are left in a graph between simplices of two dimensions. Arcs are made of other arcs,
/// and share them. Written out as they are, they could have exponentially many cells, and pass almost all of these to
/// and fro. So each arc is written out once, after its parts and without loops, and forgotten after the last arc that
/// needs it.
template <class Cell>
class JoinedPaths {
 public:
  JoinedPaths(const MorseGraph& graph, int low_dimension, const Separatrices<Cell>& separatrices)
      : graph_(graph), separatrices_(separatrices), uses_(graph.arcs().size()) {
    const auto& arcs = graph.arcs();
    for (std::size_t i = arcs.size(); i-- > 0;) {  // parts have lower numbers
      if (graph.dimension(arcs[i].low) != low_dimension || arcs[i].separatrix != no_id) continue;
      if (arcs[i].is_alive) ++uses_[i];
      if (uses_[i] != 0) {
        for (const int part : {arcs[i].start, arcs[i].middle, arcs[i].end}) ++uses_[part];
      }
    }
    for (std::size_t i = 0; i < arcs.size(); ++i) {
      if (uses_[i] != 0 && arcs[i].separatrix == no_id) join(static_cast<int>(i));
    }
  }

  /// Appends the cells of an arc that is left; once.
  void append(int arc, std::vector<Cell>& cells) {
    const Part part = part_of(arc);
    cells.insert(cells.end(), part.begin, part.end);
    release(arc);
  }

 private:
  struct Part {
    const Cell *begin, *end;
  };

  struct Hash {
    std::size_t operator()(Id cell) const {
      return static_cast<std::size_t>((std::uint64_t(static_cast<std::uint32_t>(cell)) * 0x9e3779b97f4a7c15u) >> 20);
    }
    std::size_t operator()(const TriangleVertices& cell) const {
      std::size_t hash = 0;
      for (const Id vertex : cell) hash = (*this)(vertex) ^ (hash * 31);
      return hash;
    }
  };

  Part part_of(int arc) const {
    const Id separatrix = graph_.arcs()[arc].separatrix;
    if (separatrix != no_id) return {separatrices_.first(separatrix), separatrices_.last(separatrix)};
    const auto& cells = joined_.at(arc);
    return {cells.data(), cells.data() + cells.size()};
  }

  void release(int arc) {
    if (graph_.arcs()[arc].separatrix == no_id && --uses_[arc] == 0) joined_.erase(arc);
  }

  void join(int number) {
    const MorseGraph::Arc& arc = graph_.arcs()[number];
    const Part start = part_of(arc.start), middle = part_of(arc.middle), end = part_of(arc.end);
    for (const Cell* cell = start.begin; cell != start.end; ++cell) add(*cell);
    for (const Cell* cell = middle.end; cell != middle.begin; --cell) add(cell[-1]);
    for (const Cell* cell = end.begin; cell != end.end; ++cell) add(*cell);
    joined_.emplace(number, path_);
    for (const Cell& cell : path_) place_.erase(cell);  // clear() would sweep all that it has ever grown to
    path_.clear();
    for (const int part : {arc.start, arc.middle, arc.end}) release(part);
  }

  /// Appends a cell to the path. If the path has passed it before, the loop since then is dropped.
  void add(const Cell& cell) {
    const auto [place, is_new] = place_.emplace(cell, path_.size());
    if (is_new) {
      path_.push_back(cell);
      return;
    }
    for (std::size_t i = place->second + 1; i < path_.size(); ++i) place_.erase(path_[i]);
    path_.resize(place->second + 1);
  }

  const MorseGraph& graph_;
  const Separatrices<Cell>& separatrices_;
  std::vector<int> uses_;
  std::unordered_map<int, std::vector<Cell>> joined_;
  std::vector<Cell> path_;
  std::unordered_map<Cell, std::size_t, Hash> place_;
};

}  // namespace gale::detail
