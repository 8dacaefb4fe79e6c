#include <gale/base/bits.hpp>
#include <gale/base/parallel.hpp>
#include <gale/ttk/first_met.hpp>

namespace gale::ttk {

FirstMet::FirstMet(Id cells) {
  words_ = allocate<Array<EightCells, HostMemory>>("GALE::ttk_first_met", Offset(cells) / 8 + 1);
  fill("GALE::ttk_clear_met", HostExecutionSpace(), words_, EightCells{});
}

void FirstMet::count(Id simplices) {
  const HostExecutionSpace host;
  const auto words = words_;
  const auto count = static_cast<Offset>(words.extent(0));
  const auto before = allocate<Array<Id, HostMemory>>("GALE::ttk_met_before", count + 1);
  exclusive_scan("GALE::ttk_count_met", host, count, before, [&](Offset w) { return count_bits(words(w).bits()); });
  const auto samples = samples_ = allocate<Array<Id, HostMemory>>("GALE::ttk_met_samples", simplices / step + 2);
  fill("GALE::ttk_clear_samples", host, samples, static_cast<Id>(count - 1));
  parallel_for("GALE::ttk_sample_met", host, count, [&](Offset w) {
    words(w).before = before(w);
    for (Offset k = (Offset(before(w)) + step - 1) / step; k * step < before(w + 1); ++k) {
      samples(k) = static_cast<Id>(w);
    }
  });
}

Id FirstMet::number(Id cell, int place) const {
  const EightCells& word = words_.data()[cell / 8];
  const std::uint64_t lower = (std::uint64_t(1) << (8 * (cell % 8) + place)) - 1;
  return word.before + count_bits(word.bits() & lower);
}

}  // namespace gale::ttk
