#pragma once

#include <gale/base/bits.hpp>
#include <gale/relations/kernels/bit_star_scratch.hpp>
#include <gale/relations/kernels/star_request.hpp>

namespace gale::detail {

/// The stars of a small segment, as matrices of bits in its own numbering of cells and vertices, which ascends as
/// their ids do: a set that is read bit after bit is in order, and bits counted give places. No warp works together;
/// after the first step nothing is atomic.
///
///     visit the segment's cells: set their bits in the stars of its vertices; number the vertices outside
///     count and scan the stars: star_begin
///     a lane a vertex: list its star, and set the bits of its neighbours
///     count and scan the neighbours; reserve the blocks; write VT and link
///     a lane a vertex: list its neighbours; write VV
///
/// Matrices grow with the square of a segment: see `is_for`.
template <class Team, class Memory, int corners>
class BitStars {
 public:
  using Request = StarRequest<Memory, corners>;
  using Segment = StarSegment<Memory>;

  KOKKOS_FORCEINLINE_FUNCTION static std::size_t scratch_bytes(const StarSizes& sizes, int /*warps*/) {
    return BitStarScratch(nullptr, sizes).bytes;
  }

  /// Numbers must have room in 16 bits, those of cells with 2 bits for a corner.
  KOKKOS_FORCEINLINE_FUNCTION static bool is_for(const StarSizes& sizes) {
    return sizes.rows + Offset(sizes.outside) <= 0x10000 && sizes.cells <= 0x4000 && sizes.star <= 0x10000 &&
           Offset(sizes.rows) * sizes.cells <= 0x80000;
  }

  KOKKOS_FORCEINLINE_FUNCTION BitStars(const Team& team, const Request& request, const Segment& segment, char* memory)
      : team_(team),
        request_(request),
        segment_(segment),
        scratch_(memory, request.sizes),
        vertices_(scratch_, request.sizes, segment.first, segment.rows),
        gathers_(request.gathers_neighbours()) {}

  /// By all. Leaves blocks in the pool and in StarShared, where it fits.
  KOKKOS_FORCEINLINE_FUNCTION void compute() const {
    auto& shared = *scratch_.shared;
    if (!has_room()) {
      team::once(team_, [&] {
        shared.found.cells = segment_.cells.count;
        shared.found.outside = gathers_ ? usual_outside(segment_.cells.count) : 0;
      });
      return;
    }
    clear();
    team::barrier(team_);
    mark_cells();
    team::barrier(team_);
    if (!fits()) return;
    count_stars();
    if (gathers_) vertices_.list(team_);
    team::exclusive_scan(team_, segment_.rows, scratch_.star_begin);
    team::once(team_, [&] { shared.found.star = scratch_.star_begin[segment_.rows]; });
    if (gathers_ && vertices_.fit()) vertices_.rank(team_);
    team::barrier(team_);
    if (!fits()) return;
    if (gathers_) number_corners();
    team::barrier(team_);
    list_stars();
    team::barrier(team_);
    if (gathers_) {
      count_neighbours();
      team::exclusive_scan(team_, segment_.rows, scratch_.degree);
    }
    const Id neighbours = gathers_ ? scratch_.degree[segment_.rows] : 0;
    if (neighbours > request_.sizes.neighbours) {
      team::once(team_, [&] { shared.found.neighbours = neighbours; });
      return;
    }
    reserve_blocks(team_, request_, star_relations_of(corners - 1), shared, segment_.rows, scratch_.star_begin,
                   neighbours);
    if (shared.vt != BlockPool::missing) write_stars();
    if (shared.link != BlockPool::missing) write_links();
    if (request_.wanted.has(Relation::VV)) write_neighbours();
  }

 private:
  static constexpr int others = corners - 1;

  KOKKOS_FORCEINLINE_FUNCTION bool fits() const { return request_.sizes.contains(scratch_.shared->found); }

  /// For what is known before the first step.
  KOKKOS_FORCEINLINE_FUNCTION bool has_room() const {
    const StarSizes& sizes = request_.sizes;
    return sizes.rows >= segment_.rows && sizes.cells >= segment_.cells.count && (sizes.outside > 0 || !gathers_);
  }

  KOKKOS_FORCEINLINE_FUNCTION Id star_words() const {
    return static_cast<Id>(BitStarScratch::words(segment_.cells.count));
  }
  KOKKOS_FORCEINLINE_FUNCTION Id neighbour_words() const {
    return static_cast<Id>(BitStarScratch::words(segment_.rows + scratch_.shared->found.outside));
  }

  KOKKOS_FORCEINLINE_FUNCTION void clear() const {
    team::for_all(team_, star_words() * segment_.rows, [&](Id i) { scratch_.star_bits[i] = 0; });
    if (gathers_) vertices_.clear(team_);
  }

  KOKKOS_FORCEINLINE_FUNCTION void mark_cells() const {
    const Id rows = segment_.rows;
    const auto load = [&](Id i) { return request_.mesh.cell(segment_.cells[i]); };
    team::for_all_loaded(team_, segment_.cells.count, load, [&](Id i, const Quad& four) {
      std::uint32_t* const bits = scratch_.star_bits + (i / 32) * rows;
      std::uint64_t numbers = 0;
      std::uint32_t outside = 0;
      for (int corner = 0; corner < corners; ++corner) {
        const Id row = segment_.row_of(four[corner]);
        if (segment_.has(row)) {
          team::set_bits(team_, bits + row, std::uint32_t(1) << (i % 32));
          numbers |= std::uint64_t(row) << (16 * corner);
        } else if (gathers_) {
          const Id slot = vertices_.first_slot(four[corner]);
          if (vertices_.key(slot) == four[corner]) {
            numbers |= std::uint64_t(rows + slot) << (16 * corner);
          } else {
            outside |= 1u << corner;
          }
        }
      }
      if (!gathers_) return;
      team::reconverge_after([&] {
        vertices_.insert(team_, four, outside,
                         [&](int corner, Id slot) { numbers |= std::uint64_t(rows + slot) << (16 * corner); });
      });
      CornerNumbers of{};
      for (int corner = 0; corner < corners; ++corner)
        of.of[corner] = static_cast<std::uint16_t>(numbers >> (16 * corner));
      scratch_.corners[i] = of;
    });
  }

  KOKKOS_FORCEINLINE_FUNCTION void count_stars() const {
    team::for_all(team_, segment_.rows, [&](Id row) {
      Id count = 0;
      for (Id word = 0; word < star_words(); ++word)
        count += count_bits(scratch_.star_bits[word * segment_.rows + row]);
      scratch_.star_begin[row] = count;
      team::raise(team_, &scratch_.shared->longest_star, count);
    });
  }

  /// From rows and slots to numbers.
  KOKKOS_FORCEINLINE_FUNCTION void number_corners() const {
    const Id rows = segment_.rows;
    team::for_all(team_, segment_.cells.count, [&](Id i) {
      CornerNumbers numbers = scratch_.corners[i];
      for (int corner = 0; corner < corners; ++corner) {
        std::uint16_t& number = numbers.of[corner];
        number = static_cast<std::uint16_t>(number < rows ? vertices_.number_of_row(number)
                                                          : vertices_.number_of_slot(number - rows));
      }
      scratch_.corners[i] = numbers;
    });
    team::for_all(team_, neighbour_words() * rows, [&](Id i) { scratch_.neighbour_bits[i] = 0; });
  }

  KOKKOS_FORCEINLINE_FUNCTION void list_stars() const {
    team::for_all(team_, segment_.rows, [&](Id row) {
      std::uint16_t* out = scratch_.star + scratch_.star_begin[row];
      for_each_bit(scratch_.star_bits + row, segment_.rows, star_words(),
                   [&](Id tetrahedron) { *out++ = static_cast<std::uint16_t>(tetrahedron); });
      if (gathers_) gather_neighbours(row);
    });
  }

  /// Sets the bits of all vertices of the cells around one, and takes its own away again. Several cells at a
  /// time: it waits for each.
  KOKKOS_FORCEINLINE_FUNCTION void gather_neighbours(Id row) const {
    constexpr Id at_once = 4;
    const Id self = vertices_.number_of_row(row), end = scratch_.star_begin[row + 1];
    const bool links = request_.wanted.has_links();
    std::uint32_t* const column = scratch_.neighbour_bits + row;
    for (Id begin = scratch_.star_begin[row]; begin < end; begin += at_once) {
      CornerNumbers numbers[at_once];
      Id cells[at_once];
      for (Id i = 0; i < at_once; ++i) {
        cells[i] = scratch_.star[begin + i < end ? begin + i : begin];
        numbers[i] = scratch_.corners[cells[i]];
      }
      for (Id i = 0; i < at_once; ++i) {
        for (int corner = 0; corner < corners; ++corner) {
          const std::uint32_t number = numbers[i].of[corner];
          team::set_bits(team_, column + (number / 32) * segment_.rows, std::uint32_t(1) << (number % 32));
        }
        if (links && begin + i < end) {
          const Id corner = numbers[i].of[1] == self                   ? 1
                            : numbers[i].of[2] == self                 ? 2
                            : corners == 4 && numbers[i].of[3] == self ? 3
                                                                       : 0;
          scratch_.star[begin + i] = static_cast<std::uint16_t>(4 * cells[i] + corner);
        }
      }
    }
    column[(self / 32) * segment_.rows] &= ~(std::uint32_t(1) << (self % 32));
  }

  KOKKOS_FORCEINLINE_FUNCTION void write_stars() const {
    Id* const out = request_.pool.words + scratch_.shared->vt + segment_.rows + 1;
    const int shift = request_.wanted.has_links() ? 2 : 0;
    team::for_all(team_, scratch_.shared->found.star,
                  [&](Id i) { out[i] = segment_.cells[scratch_.star[i] >> shift]; });
  }

  KOKKOS_FORCEINLINE_FUNCTION void count_neighbours() const {
    const Id rows = segment_.rows, words = neighbour_words();
    team::for_all(team_, rows, [&](Id row) {
      Id count = 0;
      for (Id word = 0; word < words; ++word) {
        scratch_.before[word * rows + row] = static_cast<std::uint16_t>(count);
        count += count_bits(scratch_.neighbour_bits[word * rows + row]);
      }
      scratch_.degree[row] = count;
    });
  }

  /// Four cells a lane: their places, of a byte each, are `others` words.
  KOKKOS_FORCEINLINE_FUNCTION void write_links() const {
    const Id stars = scratch_.shared->found.star;
    const LinkPlaces link(request_.pool.words + scratch_.shared->link, segment_.rows);
    if (link.width > 1) {
      team::for_all(team_, stars, [&](Id i) {
        std::uint32_t at = 0;
        for_each_place(i, [&](Id place) { link.put(others * Offset(i) + at++, place); });
      });
      return;
    }
    std::uint32_t* const out = static_cast<std::uint32_t*>(link.places);
    const Id words = (others * stars + 3) / 4;
    team::for_all(team_, (stars + 3) / 4, [&](Id four) {
      std::uint64_t low = 0;
      std::uint32_t high = 0;
      int at = 0;
      for (Id i = 4 * four; i < 4 * four + 4 && i < stars; ++i) {
        for_each_place(i, [&](Id place) {
          if (at < 8) {
            low |= static_cast<std::uint64_t>(place) << (8 * at);
          } else {
            high |= static_cast<std::uint32_t>(place) << (8 * (at - 8));
          }
          ++at;
        });
      }
      out[others * four] = static_cast<std::uint32_t>(low);
      if (others * four + 1 < words) out[others * four + 1] = static_cast<std::uint32_t>(low >> 32);
      if (others == 3 && others * four + 2 < words) out[others * four + 2] = high;
    });
  }

  /// Calls visit(place) for the vertices across from the corner that the entry `i` of all stars is, ascending.
  template <class Visit>
  KOKKOS_FORCEINLINE_FUNCTION void for_each_place(Id i, const Visit& visit) const {
    const Id entry = scratch_.star[i];
    const CornerNumbers numbers = scratch_.corners[entry / 4];
    const Id own_corner = entry % 4;
    const Id own = own_corner == 0   ? numbers.of[0]
                   : own_corner == 1 ? numbers.of[1]
                   : own_corner == 2 ? numbers.of[2]
                                     : numbers.of[3];
    const Id row = own - scratch_.shared->below;
    for (int other = 0; other < others; ++other) {
      const Id number = other < own_corner ? numbers.of[other] : numbers.of[other + 1];
      const Id cell = (number / 32) * segment_.rows + row;
      const std::uint32_t lower = (std::uint32_t(1) << (number % 32)) - 1;
      visit(scratch_.before[cell] + count_bits(scratch_.neighbour_bits[cell] & lower));
    }
  }

  KOKKOS_FORCEINLINE_FUNCTION void write_neighbours() const {
    const Id rows = segment_.rows, words = neighbour_words();
    auto& shared = *scratch_.shared;
    const Id neighbours = scratch_.degree[rows];
    if (shared.vv == BlockPool::missing) return;
    team::for_all(team_, rows, [&](Id row) {
      std::uint16_t* out = scratch_.neighbours + scratch_.degree[row];
      for_each_bit(scratch_.neighbour_bits + row, rows, words,
                   [&](Id number) { *out++ = static_cast<std::uint16_t>(number); });
    });
    team::barrier(team_);
    Id* const offsets = request_.pool.words + shared.vv;
    Id* const ids = offsets + rows + 1;
    team::for_all(team_, rows + 1, [&](Id row) { offsets[row] = scratch_.degree[row]; });
    team::for_all(team_, neighbours, [&](Id i) { ids[i] = vertices_.vertex(scratch_.neighbours[i]); });
  }

  const Team& team_;
  const Request& request_;
  const Segment& segment_;
  BitStarScratch scratch_;
  OutsideVertices vertices_;
  bool gathers_;
};

}  // namespace gale::detail
