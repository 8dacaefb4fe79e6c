#include "star_rows.hpp"

#include <algorithm>

#include <gale/algorithms/links/small_link.hpp>

namespace gale::ttk {

namespace {

/// Ascending, by digits of `bits` bits; few by comparing. Most come sorted: one thread has put them there.
void sort_ids(std::vector<Id>& ids, std::vector<Id>& other) {
  if (std::is_sorted(ids.begin(), ids.end())) return;
  constexpr std::size_t few = 64;
  constexpr int bits = 9;
  if (ids.size() <= few) {
    std::sort(ids.begin(), ids.end());
    return;
  }
  const auto [least, greatest] = std::minmax_element(ids.begin(), ids.end());
  const Id lowest = *least, range = *greatest - lowest;
  other.resize(ids.size());
  for (int shift = 0; shift < 31 && range >> shift > 0; shift += bits) {
    const auto digit = [&](Id id) { return (id - lowest) >> shift & ((1 << bits) - 1); };
    std::array<Id, (1 << bits) + 1> begin{};
    for (const Id id : ids) ++begin[digit(id) + 1];
    for (int i = 0; i < 1 << bits; ++i) begin[i + 1] += begin[i];
    for (const Id id : ids) other[begin[digit(id)]++] = id;
    ids.swap(other);
  }
}

}  // namespace

void StarRows::find(Id segment) {
  if (segment == segment_) return;
  segment_ = no_id;  // unless all goes well
  first_ = segments_.vertices(segment).first;
  rows_ = segments_.vertices(segment).size();
  segments_.gather(segment, near_);
  sort_ids(near_, unsorted_);
  number_corners();
  place_cells();
  segment_ = segment;
}

/// Counts the stars, too.
void StarRows::number_corners() {
  constexpr std::size_t ahead = 12, many_outside = 1 << 14;
  const Id *const vertex_input = segments_.vertex_input(), *const vertex_internal = segments_.vertex_internal();
  vertices_.assign(vertex_input + first_, vertex_input + first_ + rows_);
  if (outside_.size() > many_outside) {
    outside_ = HashTable<Id>();  // what one segment has made large would have the others miss the cache
  } else {
    outside_.clear();
  }
  star_begin_.assign(rows_ + 1, 0);
  corners_.resize(near_.size());
  for (std::size_t i = 0; i < near_.size(); ++i) {
    if (i + ahead < near_.size()) cells_.prefetch(near_[i + ahead]);
    for (int corner = 0; corner < cells_.corners(); ++corner) {
      const Id vertex = cells_.vertex(near_[i], corner);
      Id number = vertex_internal[vertex] - first_;
      if (number >= 0 && number < rows_) {
        ++star_begin_[number + 1];
      } else {
        const auto [known, is_new] = outside_.insert(static_cast<std::uint32_t>(vertex));
        if (is_new) {
          known = static_cast<Id>(vertices_.size());
          vertices_.push_back(vertex);
        }
        number = known;
      }
      corners_[i][corner] = number;
    }
  }
}

void StarRows::place_cells() {
  for (Id row = 0; row < rows_; ++row) star_begin_[row + 1] += star_begin_[row];
  star_.resize(star_begin_[rows_]);
  for (Id i = 0; i < static_cast<Id>(near_.size()); ++i) {
    for (int corner = 0; corner < cells_.corners(); ++corner) {
      const Id number = corners_[i][corner];
      if (number < rows_) star_[star_begin_[number]++] = i;
    }
  }
  for (Id row = rows_; row > 0; --row) star_begin_[row] = star_begin_[row - 1];
  star_begin_[0] = 0;
}

Block StarRows::stars() const {
  Block block(first_, rows_, star_.size());
  std::copy(star_begin_.begin(), star_begin_.end(), block.words.get());
  Id* to = block.words.get() + rows_ + 1;
  for (const Id i : star_) *to++ = near_[i];
  return block;
}

Block StarRows::neighbours() {
  met_.assign(vertices_.size(), 0);
  on_surface_.clear();
  words_.resize(rows_ + 1 + cells_.dimension() * star_.size());
  Id* const begin = words_.data() + rows_ + 1;
  Id* end = begin;
  for (Id row = 0; row < rows_; ++row) {
    words_[row] = static_cast<Id>(end - begin);
    end = cells_.corners() == 3 ? add_neighbours<3>(row, end) : add_neighbours<4>(row, end);
  }
  words_[rows_] = static_cast<Id>(end - begin);
  Block block(first_, rows_, end - begin);
  std::copy(words_.data(), end, block.words.get());
  return block;
}

/// Writes a row; returns its end.
template <int corners>
Id* StarRows::add_neighbours(Id row, Id* to) {
  const Id size = star_begin_[row + 1] - star_begin_[row];
  places_.resize((corners - 1) * std::size_t(size));
  if (parity_.size() < places_.size()) parity_.resize(places_.size());
  const std::uint64_t mine = std::uint64_t(row + 1) << 32;
  Id neighbours = 0;
  Id* place = places_.data();
  for (Id i = star_begin_[row]; i < star_begin_[row + 1]; ++i) {
    for (int corner = 0; corner < corners; ++corner) {
      const Id number = corners_[star_[i]][corner];
      if (number == row) continue;
      std::uint64_t& met = met_[number];
      if ((met >> 32) != (mine >> 32)) {
        met = mine | static_cast<std::uint32_t>(neighbours);
        parity_[neighbours++] = 0;
        *to++ = vertices_[number];
      }
      *place++ = static_cast<Id>(met & 0xffffffff);
    }
    if constexpr (corners == 3) {
      parity_[place[-2]] ^= 1;
      parity_[place[-1]] ^= 1;
      continue;
    }
    const auto bit = [&](int corner) { return std::uint64_t(1) << (place[corner - 3] & 63); };
    parity_[place[-3]] ^= bit(1) | bit(2);
    parity_[place[-2]] ^= bit(0) | bit(2);
    parity_[place[-1]] ^= bit(0) | bit(1);
  }
  if (is_on_surface(row, neighbours)) on_surface_.push_back(vertices_[row]);
  return to;
}

/// An edge of the link with one triangle, or a vertex with one edge, would leave a bit; so do some without, in meshes
/// that are no manifolds.
bool StarRows::is_on_surface(Id row, Id neighbours) {
  using gale::detail::SmallLink;
  const int others = cells_.dimension();
  const LinkRow link{places_.data(), star_begin_[row + 1] - star_begin_[row], sizeof(Id), others};
  if (neighbours > SmallLink::capacity) {
    for (auto i = places_.begin(); i != places_.end(); i += others) std::sort(i, i + others);  // as links have them
    large_.build(link);
    return large_.is_open();
  }
  std::uint64_t odd = 0;
  for (Id i = 0; i < neighbours; ++i) odd |= parity_[i];
  return odd != 0 && SmallLink(neighbours, link).is_open();
}

}  // namespace gale::ttk
