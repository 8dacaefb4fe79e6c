#pragma once

#include <cstdint>
#include <cstring>

#include <gale/base/memory.hpp>
#include <gale/base/types.hpp>
#include <gale/export.hpp>

namespace gale::ttk {

/// Which of its edges, or triangles, each cell is the first to have, when one goes through the cells: bits, eight for a
/// cell. Their numbers are the places of the bits that are set, so that neither a simplex's number nor its first cell
/// is stored: 1.5 bytes a cell, and a fourth of a byte a simplex.
class GALE_EXPORT FirstMet {
 public:
  /// Begins with so many cells, none of which has any yet.
  explicit FirstMet(Id cells);
  FirstMet() = default;

  /// The cell is the first to have that one of its simplices. By several threads.
  void meet(Id cell, int place) const {
    __atomic_fetch_or(&words_.data()[cell / 8].fresh[cell % 8], static_cast<std::uint8_t>(1u << place),
                      __ATOMIC_RELAXED);
  }

  /// Counts, after which simplices may be asked for.
  void count(Id simplices);

  struct At {
    Id cell;
    int place;
  };

  /// The simplex of a number.
  At operator[](Id simplex) const {
    Id low = samples_.data()[simplex / step], high = samples_.data()[simplex / step + 1];
    while (low < high) {
      const Id middle = low + (high - low + 1) / 2;
      if (words_.data()[middle].before <= simplex) {
        low = middle;
      } else {
        high = middle - 1;
      }
    }
    const EightCells& word = words_.data()[low];
    std::uint64_t bits = word.bits();
    for (Id left = simplex - word.before; left > 0; --left) bits &= bits - 1;
    const int bit = __builtin_ctzll(bits);
    return {8 * low + bit / 8, bit % 8};
  }

  /// The number of one that was met.
  Id number(Id cell, int place) const;

  std::size_t bytes() const { return words_.span() * sizeof(EightCells) + samples_.span() * sizeof(Id); }

 private:
  struct EightCells {
    Id before;              ///< simplices that earlier cells are the first to have
    std::uint8_t fresh[8];  ///< by cell

    std::uint64_t bits() const {
      static_assert(__BYTE_ORDER__ == __ORDER_LITTLE_ENDIAN__);
      std::uint64_t all;
      std::memcpy(&all, fresh, sizeof all);
      return all;
    }
  };

  static constexpr Id step = 16;

  Array<EightCells, HostMemory> words_;
  Array<Id, HostMemory> samples_;  ///< where every 16th simplex is, and the last
};

}  // namespace gale::ttk
