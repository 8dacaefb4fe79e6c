#pragma once

#include <cstdint>

#include <gale/relations/kernels/star_request.hpp>

namespace gale::detail {

/// What the four vertices of a tetrahedron are called within a segment.
struct alignas(8) CornerNumbers {
  std::uint16_t of[4];
};

/// What a lane reads at once.
struct alignas(16) FourIds {
  Id of[4];
};

/// The scratch memory of a team that goes the way of BitStars, divided. Matrices of bits have a column for each vertex
/// of the segment and lie word after word, so that lanes which go down a column each never meet in a bank. What is
/// needed at different times shares a place.
struct BitStarScratch {
  StarShared* shared;
  Id* star_begin;  ///< rows + 1
  Id* degree;      ///< rows + 1: neighbours of each vertex, later where its VV row begins

  std::uint32_t* star_bits;   ///< column of a vertex: the tetrahedra of its star, as SegmentTetrahedra counts them
  std::uint16_t* neighbours;  ///< numbers, row after row; in the place of star_bits

  std::uint16_t* star;     ///< tetrahedra as star_bits counts them, row after row; for links 4 * tetrahedron + corner
  Id* keys;                ///< in the place of `star`: hash slots for the vertices outside, later their numbers
  FourIds* list;           ///< there too: those vertices as they came
  std::uint16_t* slot_of;  ///< and their slots

  Id* outside;                    ///< those vertices, ascending
  CornerNumbers* corners;         ///< of each tetrahedron
  std::uint32_t* neighbour_bits;  ///< column of a vertex: the numbers of its neighbours
  std::uint16_t* before;          ///< how many bits are set above each word of neighbour_bits

  std::size_t bytes;

  KOKKOS_FORCEINLINE_FUNCTION BitStarScratch(char* memory, const StarSizes& sizes) {
    std::size_t end = 0;
    const auto place = [memory](std::size_t& at, std::size_t count, auto*& array) {
      using Entry = std::remove_reference_t<decltype(*array)>;
      array = reinterpret_cast<Entry*>(memory + at);
      at += (count * sizeof(Entry) + 15) / 16 * 16;
    };
    const std::size_t rows = sizes.rows, outside = sizes.outside, tetrahedra = outside > 0 ? sizes.tetrahedra : 0;
    place(end, 1, shared);
    place(end, rows + 1, star_begin);
    place(end, rows + 1, degree);

    std::size_t end_of_bits = end, end_of_neighbours = end;
    place(end_of_bits, words(sizes.tetrahedra) * rows, star_bits);
    place(end_of_neighbours, outside > 0 ? sizes.neighbours : 0, neighbours);
    end = end_of_bits > end_of_neighbours ? end_of_bits : end_of_neighbours;

    std::size_t end_of_star = end;
    place(end_of_star, sizes.star, star);
    place(end, slots(sizes), keys);
    place(end, (outside + 3) / 4, list);
    place(end, outside, slot_of);
    if (end < end_of_star) end = end_of_star;

    place(end, outside, this->outside);
    place(end, tetrahedra, corners);
    const std::size_t matrix = outside > 0 ? words(sizes.rows + sizes.outside) * rows : 0;
    place(end, matrix, neighbour_bits);
    place(end, matrix, before);
    bytes = end;
  }

  /// Words of 32 bits each.
  KOKKOS_FORCEINLINE_FUNCTION static std::size_t words(std::size_t bits) { return (bits + 31) / 32; }

  /// Hash slots, a power of two, for that many vertices outside. None where no neighbours are gathered.
  KOKKOS_FORCEINLINE_FUNCTION static std::size_t slots(const StarSizes& sizes) {
    if (sizes.outside == 0) return 0;
    std::size_t slots = 8;
    while (2 * slots < 5 * std::size_t(sizes.outside)) slots *= 2;
    return slots;
  }
};

}  // namespace gale::detail
