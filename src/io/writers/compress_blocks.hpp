#pragma once

#include <algorithm>
#include <map>
#include <mutex>

#include <gale/base/threads.hpp>
#include <gale/io/bytes/compression.hpp>
#include <gale/io/writers/writers.hpp>

namespace gale::io::detail {

/// What is compressed by itself.
constexpr std::uint64_t block_bytes = 1 << 18;

/// Compresses an array, so many values a block, on all threads; calls write(i, bytes) for the i-th block, one after the
/// other. The last one has zeros behind its values if `is_whole`.
template <class Write>
void compress_blocks(const WrittenArray& array, std::uint64_t block, bool is_whole, const Write& write) {
  const std::size_t size = size_of(array.type);
  const auto blocks = static_cast<std::int64_t>((array.count + block - 1) / block);
  const auto threads = static_cast<int>(std::min<std::int64_t>(host_threads(), blocks));
  std::vector<std::vector<char>> plain(threads), compressed(threads);
  std::map<std::int64_t, std::vector<char>> waiting;  // blocks behind one that isn't ready
  std::vector<std::vector<char>> spare;               // that waited
  std::int64_t next = 0;
  std::mutex mutex;
  in_turns(threads, blocks, [&](int thread, std::int64_t i) {
    const std::uint64_t begin = i * block, end = std::min(begin + block, array.count);
    const std::size_t bytes = (end - begin) * size, filled = is_whole ? block * size : bytes;
    if (array.values != nullptr && filled == bytes) {
      compress_by_zlib(size, array.values + begin * size, bytes, compressed[thread]);
    } else {
      plain[thread].resize(filled);
      array.copy(begin, end, plain[thread].data());
      std::fill(plain[thread].begin() + static_cast<std::ptrdiff_t>(bytes), plain[thread].end(), '\0');
      compress_by_zlib(size, plain[thread].data(), filled, compressed[thread]);
    }
    const std::lock_guard<std::mutex> lock(mutex);
    if (i != next) {
      waiting.emplace(i, std::move(compressed[thread]));
      compressed[thread].clear();
      if (spare.empty()) return;
      compressed[thread].swap(spare.back());
      return spare.pop_back();
    }
    write(next++, compressed[thread]);
    for (auto first = waiting.begin(); first != waiting.end() && first->first == next; first = waiting.erase(first)) {
      write(next++, first->second);
      if (spare.size() < compressed.size()) spare.push_back(std::move(first->second));
    }
  });
}

}  // namespace gale::io::detail
