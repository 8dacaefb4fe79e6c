#pragma once

#include <algorithm>
#include <cstdint>
#include <vector>

#include <gale/ttk/block_store.hpp>
#include <gale/ttk/cells.hpp>

namespace gale::ttk {

/// Makes a block row by row. One serves one thread, for one block after the other, and keeps its memory.
class BlockBuilder {
 public:
  void begin(Id first, Id rows) {
    first_ = first;
    rows_ = rows;
    row_ = 0;
    words_.resize(rows + 1);  // the offsets
    words_[0] = 0;
  }

  void add(Id entry) { words_.push_back(entry); }

  /// GALE's ids, by their numbers, ascending.
  template <class Numbers>
  void add_sorted(const Row& row, const Numbers& numbers) {
    const auto begin = static_cast<std::ptrdiff_t>(words_.size());
    for (const Id entry : row) words_.push_back(numbers[entry]);
    std::sort(words_.begin() + begin, words_.end());
  }

  void end_row() { words_[++row_] = static_cast<Id>(words_.size()) - rows_ - 1; }

  Block take() const {
    Block block(first_, rows_, words_.size() - rows_ - 1);
    std::copy(words_.begin(), words_.end(), block.words.get());
    return block;
  }

 private:
  Id first_ = 0, rows_ = 0, row_ = 0;
  std::vector<Id> words_;
};

/// The star of a vertex in the order of the caller's cells. Likewise.
class StarOrder {
 public:
  /// `star`: the vertex's VT row; `input`: GALE's tetrahedron -> cell. The first cells are fetched from memory
  /// meanwhile: most neighbours are met there.
  void sort(const Row& star, const Id* input, const Cells& cells) {
    keys_.resize(star.size());
    for (Id i = 0; i < star.size(); ++i) {
      const std::uint64_t key = static_cast<std::uint64_t>(input[star[i]]) << 32 | static_cast<std::uint32_t>(i);
      Id at = i;
      if (i < few) {
        for (; at > 0 && keys_[at - 1] > key; --at) keys_[at] = keys_[at - 1];
      }
      keys_[at] = key;
    }
    if (size() > few) std::sort(keys_.begin(), keys_.end());
    for (Id i = 0; i < std::min(size(), fetched); ++i) cells.prefetch(cell(i));
  }

  Id size() const { return static_cast<Id>(keys_.size()); }
  Id cell(Id i) const { return static_cast<Id>(keys_[i] >> 32); }
  Id place(Id i) const { return static_cast<Id>(keys_[i] & 0xffffffff); }  ///< in the VT row

  /// Adds the vertex's neighbours in the order of the edges to them. That is the order in which one meets them in the
  /// cells of the star, ascending, and in each cell as the caller has its corners.
  void add_neighbours(BlockBuilder& to, const Row& neighbours, const LinkRow& link, const Cells& cells,
                      const Id* vertex_input) {
    met_.assign((neighbours.size() + 63) / 64, 0);
    for (Id i = 0, left = neighbours.size(); left > 0 && i < size(); ++i) {
      Id fresh[3];
      int count = 0;
      for (int corner = 0; corner < link.others; ++corner) {
        const Id place = link(this->place(i), corner);
        const std::uint64_t bit = std::uint64_t(1) << (place % 64);
        if ((met_[place / 64] & bit) != 0) continue;
        met_[place / 64] |= bit;
        fresh[count++] = vertex_input[neighbours[place]];
      }
      left -= count;
      if (count == 1) {
        to.add(fresh[0]);
      } else if (count > 1) {
        for (int corner = 0; corner < cells.corners(); ++corner) {
          const Id here = cells.vertex(cell(i), corner);
          if (std::find(fresh, fresh + count, here) != fresh + count) to.add(here);
        }
      }
    }
  }

 private:
  static constexpr Id few = 32;  ///< that are sorted as they come
  static constexpr Id fetched = 12;

  std::vector<std::uint64_t> keys_;
  std::vector<std::uint64_t> met_;  ///< neighbours, by their places
};

}  // namespace gale::ttk
