#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <utility>
#include <vector>

#include <gale/base/bits.hpp>
#include <gale/base/csr.hpp>
#include <gale/mesh/encoded_mesh.hpp>
#include <gale/mesh/numbering/candidates.hpp>
#include <gale/mesh/numbering/local_order.hpp>

// What one thread finds edges and triangles with, segment after segment, and where it writes them.

namespace gale::detail {

/// Two vertices above one, in a tetrahedron of which that is the second; or the fourth twice, of which it is the third.
struct Above {
  Id low, high;
};

/// For each vertex of a segment the tetrahedra of which it is the second or third. For one thread.
class MiddleStarsOfSegment {
 public:
  explicit MiddleStarsOfSegment(const EncodedMesh<HostMemory>& mesh) : mesh_(mesh) {}

  void gather(Id segment) {
    first_ = mesh_.vertex_begin(segment);
    count_ = static_cast<std::uint32_t>(mesh_.vertex_begin(segment + 1) - first_);
    // Filling moves the start of each row to its end, which is the next row's start.
    begin_.assign(count_ + 2, 0);
    for_each(segment, [&](std::uint32_t vertex, const Above&) { ++begin_[vertex + 1]; });
    Id at = 0;
    for (Id& begin : begin_) at += std::exchange(begin, at);
    if (above_.size() < static_cast<std::size_t>(at)) above_.resize(at);
    for_each(segment, [&](std::uint32_t vertex, const Above& above) { above_[begin_[vertex + 1]++] = above; });
  }

  Span<const Above> of(Id vertex) const {
    const Id begin = begin_[vertex - first_];
    return {above_.data() + begin, begin_[vertex - first_ + 1] - begin};
  }

 private:
  template <class Visit>
  void for_each(Id segment, const Visit& visit) const {
    for (Id t = mesh_.internal_begin(segment); t < mesh_.internal_begin(segment + 1); ++t)
      visit_middle(mesh_.cell(t), visit);
    for (Offset i = mesh_.external_begin(segment); i < mesh_.external_begin(segment + 1); ++i)
      visit_middle(mesh_.cell(mesh_.external(i)), visit);
  }

  template <class Visit>
  void visit_middle(const Quad& quad, const Visit& visit) const {
    const auto second = static_cast<std::uint32_t>(quad.b - first_),
               third = static_cast<std::uint32_t>(quad.c - first_);
    if (second < count_) visit(second, Above{quad.c, quad.d});
    if (third < count_ && mesh_.dimension == 3) visit(third, Above{quad.d, quad.d});
  }

  const EncodedMesh<HostMemory> mesh_;
  Id first_ = 0;
  std::uint32_t count_ = 0;
  std::vector<Id> begin_;
  std::vector<Above> above_;
};

/// How many edges and triangles a part of the segments has.
struct SimplexCounts {
  Offset edges = 0, triangles = 0;

  SimplexCounts operator+(const SimplexCounts& other) const {
    return {edges + other.edges, triangles + other.triangles};
  }
  bool fits(const SimplexCounts& room) const { return edges <= room.edges && triangles <= room.triangles; }
};

/// Where one part writes. Tables that aren't wanted are null.
struct SimplexPlaces {
  Id *edge_low = nullptr, *edge_high = nullptr;            ///< of its first edge
  Id *triangle_begin = nullptr, *triangle_apex = nullptr;  ///< of its first edge and triangle; counted from that
  SimplexCounts room;
};

/// Finds the edges and triangles of vertices to higher ones, and writes them one vertex after the other, as long as
/// there is room. For one thread.
class SimplexFinder {
 public:
  explicit SimplexFinder(const SimplexPlaces& places) : to_(places) {}

  /// Takes the vertex's own tetrahedra and those of which it is in the middle.
  void find(Id vertex, const Quad* own, Id count, const Span<const Above>& middle) {
    collect(own, count, middle);
    find_ends(vertex);
    SimplexCounts all = found + SimplexCounts{static_cast<Offset>(ends_.size()), 0};
    if (to_.triangle_apex != nullptr) all.triangles += find_triangles(3 * count);
    if (all.fits(to_.room)) write(vertex);
    found = all;
  }

  SimplexCounts found;

 private:
  /// Edges of a vertex whose triangles are told by bits.
  static constexpr Id most_bits = 32;

  /// The higher vertices of each tetrahedron: three of own ones, then two of the others.
  void collect(const Quad* own, Id count, const Span<const Above>& middle) {
    count_ = 3 * count + static_cast<Id>(2 * middle.size());
    InputIdRanks::make_room(corners_, count_);
    Id* to = corners_.data();
    for (Id t = 0; t < count; ++t) {
      *to++ = own[t].b;
      *to++ = own[t].c;
      *to++ = own[t].d;
    }
    for (const Above& above : middle) {
      *to++ = above.low;
      *to++ = above.high;
    }
  }

  void find_ends(Id vertex) {
    FewDistinct few;
    for (Id i = 0; i < count_; ++i) {
      if (seen_.is_new(vertex, corners_[i])) few.insert(corners_[i]);
    }
    if (few.size() != FewDistinct::too_many) {
      ends_.resize(few.size());
      for (Id i = 0; i < few.size(); ++i) ends_[i] = few[i];
    } else {
      ends_.assign(corners_.begin(), corners_.begin() + count_);
      std::sort(ends_.begin(), ends_.end());
      ends_.erase(std::unique(ends_.begin(), ends_.end()), ends_.end());
    }
  }

  /// `own` corners are of the vertex's own tetrahedra. Returns how many there are.
  Offset find_triangles(Id own) {
    const auto edges = static_cast<Id>(ends_.size());
    ranks_.begin(edges);
    std::copy(ends_.begin(), ends_.end(), ranks_.ids());
    ranks_.replace_by_ranks(corners_, count_);
    if (edges > most_bits) return find_many(own);
    std::fill(joined_.begin(), joined_.begin() + edges, 0);
    const auto bit = [](Id i) { return std::uint32_t(1) << i; };
    for (const Id *corner = corners_.data(), *const end = corner + own; corner < end; corner += 3) {
      joined_[corner[0]] |= bit(corner[1]) | bit(corner[2]);
      joined_[corner[1]] |= bit(corner[2]);
    }
    for (Id i = own; i < count_; i += 2) joined_[corners_[i]] |= bit(corners_[i + 1]);
    Offset triangles = 0;
    for (Id i = 0; i < edges; ++i) {
      joined_[i] &= ~bit(i);
      triangles += count_bits(joined_[i]);
    }
    return triangles;
  }

  Offset find_many(Id own) {
    pairs_.clear();
    const auto add = [&](Id low, Id high) {
      if (low != high) pairs_.push_back(pair_key(low, high));
    };
    for (Id i = 0; i < own; i += 3) {
      add(corners_[i], corners_[i + 1]);
      add(corners_[i], corners_[i + 2]);
      add(corners_[i + 1], corners_[i + 2]);
    }
    for (Id i = own; i < count_; i += 2) add(corners_[i], corners_[i + 1]);
    std::sort(pairs_.begin(), pairs_.end());
    pairs_.erase(std::unique(pairs_.begin(), pairs_.end()), pairs_.end());
    return static_cast<Offset>(pairs_.size());
  }

  void write(Id vertex) const {
    const auto edges = static_cast<Id>(ends_.size());
    if (to_.edge_high != nullptr) {
      std::copy(ends_.begin(), ends_.end(), to_.edge_high + found.edges);
      std::fill_n(to_.edge_low + found.edges, edges, vertex);
    }
    if (to_.triangle_apex == nullptr) return;
    Id* const begin = to_.triangle_begin + found.edges;
    Id* apex = to_.triangle_apex + found.triangles;
    const auto here = [&] { return static_cast<Id>(apex - to_.triangle_apex); };
    if (edges <= most_bits) {
      for (Id i = 0; i < edges; ++i) {
        begin[i] = here();
        for (std::uint32_t rest = joined_[i]; rest != 0; rest &= rest - 1) *apex++ = ends_[lowest_bit(rest)];
      }
    } else {
      auto pair = pairs_.begin();
      for (Id i = 0; i < edges; ++i) {
        begin[i] = here();
        for (; pair != pairs_.end() && pair_first(*pair) == i; ++pair) *apex++ = ends_[pair_second(*pair)];
      }
    }
  }

  const SimplexPlaces to_;
  Id count_ = 0;
  std::vector<Id> corners_, ends_;
  std::array<std::uint32_t, most_bits> joined_;  ///< of each edge, which of those behind it it makes a triangle with
  std::vector<std::uint64_t> pairs_;  ///< pairs of edges that make triangles, where there are too many for bits
  LastSeen seen_;
  InputIdRanks ranks_;
};

}  // namespace gale::detail
