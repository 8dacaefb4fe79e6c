#pragma once

#include <algorithm>
#include <cstdint>
#include <functional>
#include <tuple>
#include <type_traits>
#include <utility>
#include <vector>

#include <gale/base/memory.hpp>
#include <gale/base/parallel.hpp>
#include <gale/base/threads.hpp>
#include <gale/base/transfer.hpp>
#include <gale/base/types.hpp>
#include <gale/mesh/exchange/entries_by_rank.hpp>
#include <gale/mesh/exchange/packed_rows.hpp>
#include <gale/mesh/ranks.hpp>

// Messages of which each rank decides by itself what it sends to whom.

namespace gale::detail {

/// Sends each rank its entries into the room that it has for them; both know how many there are. Collective.
template <class T>
void exchange(const Ranks& ranks, const EntriesByRank<T>& sent, const EntriesByRank<T>& received) {
  const auto in_bytes = [](std::vector<Offset> begin) {
    for (Offset& at : begin) at *= static_cast<Offset>(sizeof(T));
    return begin;
  };
  ranks.exchange_bytes(reinterpret_cast<const char*>(sent.entries.data()), in_bytes(sent.begin),
                       reinterpret_cast<char*>(received.entries.data()), in_bytes(received.begin));
}

/// Sends each rank its entries, and returns what all have sent here. Collective.
template <class T>
EntriesByRank<T> exchange(const Ranks& ranks, const char* label, const EntriesByRank<T>& sent) {
  const auto counts = ranks.exchange_counts(counts_of(sent));
  EntriesByRank<T> received;
  together(ranks, [&] { received = room_to_receive<T>(label, counts); });
  exchange(ranks, sent, received);
  return received;
}

/// The entries for one rank, or from it, as rows of words: integers alone, without gaps between them.
template <class T>
WordRows rows_of(const EntriesByRank<T>& all, int rank) {
  static_assert(std::has_unique_object_representations_v<T> && sizeof(T) % sizeof(std::uint32_t) == 0);
  return {all.entries.data() + all.begin[rank], all.count(rank), sizeof(T) / sizeof(std::uint32_t)};
}

/// Bytes that ranks have sent here: those of rank r are counts[r] from begin[r] on.
struct ReceivedBytes {
  Array<char, HostMemory> bytes;
  std::vector<Offset> begin;
  std::vector<std::int64_t> counts;
  std::int64_t greatest = 0;  ///< of all counts that any rank sends another one
};

/// Sends each rank what pack() has packed for it, which may throw: then all ranks throw the same SharedError. Where all
/// messages are short, they go in one step, with the news that nobody has failed. Collective.
GALE_EXPORT ReceivedBytes exchange_pieces(const Ranks& ranks, const char* label,
                                          const std::function<std::vector<PackedPieces>()>& pack);

/// Calls body(rank) for each rank but this one, of whose entries in `lists` something is to be packed or unpacked:
/// those that have many one after the other, for all threads to do so, the others side by side.
template <class Body, class... T>
void for_each_other(int here, const Body& body, const EntriesByRank<T>&... lists) {
  const int ranks = static_cast<int>(std::get<0>(std::tie(lists...)).begin.size()) - 1;
  const auto visit = [&](int rank, bool are_many) {
    if (rank != here && (are_many_to_pack(lists.count(rank)) || ...) == are_many) body(rank);
  };
  for (int rank = 0; rank < ranks; ++rank) visit(rank, true);
  in_turns(threads_for((lists.count() + ...)), ranks,
           [&](int, std::int64_t rank) { visit(static_cast<int>(rank), false); });
}

/// Lists of entries that have come from all ranks, as they came.
template <class Lists>
class ReceivedLists;

template <class... T>
class ReceivedLists<std::tuple<EntriesByRank<T>...>> {
 public:
  using Lists = std::tuple<EntriesByRank<T>...>;

  ReceivedLists(int here, Lists own, ReceivedBytes received)
      : here_(here), own_(std::move(own)), received_(std::move(received)) {}

  /// Whether any rank has sent something to another one.
  bool are_some() const { return received_.greatest > 0; }

  /// Unpacks them. Not collective.
  Lists unpack(const char* label) const {
    const int ranks = static_cast<int>(received_.counts.size());
    std::vector<std::vector<PackedList>> packed;  // by rank
    for (int rank = 0; rank < ranks; ++rank)
      packed.push_back(lists_in(received_.bytes.data() + received_.begin[rank], received_.counts[rank], sizeof...(T)));
    Lists unpacked;
    int at = 0;  // in order of the lists
    const auto make_room = [&](const auto& own, auto& list) {
      std::vector<std::int64_t> counts;
      for (int rank = 0; rank < ranks; ++rank)
        counts.push_back(rank == here_ ? own.count(here_) : packed[rank][at].rows());
      list = room_by_rank<std::decay_t<decltype(own.entries(0))>>(label, counts);
      if (own.count(here_) > 0)
        std::copy_n(own.entries.data() + own.begin[here_], own.count(here_), list.entries.data() + list.begin[here_]);
      ++at;
    };
    const auto make_all = [&](const auto&... own) {
      std::apply([&](auto&... all) { (make_room(own, all), ...); }, unpacked);
    };
    std::apply(make_all, own_);
    std::apply(
        [&](EntriesByRank<T>&... all) {
          const auto unpack_from = [&](int rank) {
            const WordRows to[] = {rows_of(all, rank)...};
            for (std::size_t i = 0; i < sizeof...(T); ++i)
              unpack_rows(packed[rank][i].bytes, packed[rank][i].count, to[i].width, to[i].words);
          };
          for_each_other(here_, unpack_from, all...);
        },
        unpacked);
    return unpacked;
  }

 private:
  int here_;
  Lists own_;  ///< of which this rank's own are there
  ReceivedBytes received_;
};

/// Sends several lists of entries, a tuple that make() returns on each rank, in one message from rank to rank, and in
/// as few bytes as pack_rows makes of them: ids, places and the like that ascend or lie near one another. A rank's own
/// stay; the others are let go when they are packed. If make() throws on some ranks, all throw. Collective.
template <class Make>
auto send_lists(const Ranks& ranks, const char* label, const Make& make) {
  using Lists = std::decay_t<decltype(make())>;
  const int here = ranks.rank();
  Lists sent;
  ReceivedBytes received = exchange_pieces(ranks, label, [&] {
    sent = make();
    std::vector<PackedPieces> pieces(ranks.size());
    std::apply(
        [&](auto&... lists) {
          for_each_other(
              here, [&](int rank) { pieces[rank] = pack_lists({rows_of(lists, rank)...}); }, lists...);
          const auto let_go = [here](auto& list) {
            if (list.count(here) == 0) list.entries = {};
          };
          (let_go(lists), ...);
        },
        sent);
    return pieces;
  });
  return ReceivedLists<Lists>(here, std::move(sent), std::move(received));
}

/// Lists that have come, unpacked on all ranks, which fail together. Collective.
template <class Lists>
Lists unpacked(const Ranks& ranks, const char* label, const ReceivedLists<Lists>& received) {
  Lists lists;
  together(ranks, [&] { lists = received.unpack(label); });
  return lists;
}

/// Exchanges several lists that are there. Collective.
template <class... T>
std::tuple<EntriesByRank<T>...> exchange_lists(const Ranks& ranks, const char* label, EntriesByRank<T>... sent) {
  return unpacked(ranks, label, send_lists(ranks, label, [&] { return std::make_tuple(std::move(sent)...); }));
}

/// Exchanges one list, likewise. Collective.
template <class T>
EntriesByRank<T> exchange_packed(const Ranks& ranks, const char* label, const EntriesByRank<T>& sent) {
  return std::get<0>(exchange_lists(ranks, label, sent));
}

/// Collects entries by rank on all ranks, which fail together. Collective.
template <class T, class RankOf, class EntryOf>
EntriesByRank<T> collect_by_rank(const Ranks& ranks, const char* label, Offset items, const RankOf& rank_of,
                                 const EntryOf& entry_of, Array<Id, HostMemory>* members = nullptr) {
  EntriesByRank<T> collected;
  together(ranks, [&] { collected = entries_by_rank<T>(ranks.size(), label, items, rank_of, entry_of, members); });
  return collected;
}

/// Rounds of messages: in each step(received) takes what others have sent here, nothing in the first, and returns what
/// it sends to others, by rank; until nobody sends anything. A rank sends itself nothing. A step may throw: then all
/// ranks do. Collective.
template <class T, class Step>
void in_rounds(const Ranks& ranks, const char* label, const Step& step) {
  EntriesByRank<T> none;
  none.begin.assign(ranks.size() + 1, 0);
  auto received = send_lists(ranks, label, [&] { return std::make_tuple(step(none)); });
  while (received.are_some())
    received = send_lists(ranks, label, [&] { return std::make_tuple(step(std::get<0>(received.unpack(label)))); });
}

/// What all ranks have of several lists, on the first one; nothing on the others. Collective.
template <class... T>
std::tuple<EntriesByRank<T>...> lists_to_first(const Ranks& ranks, const char* label, const std::vector<T>&... lists) {
  const auto for_first = [&](const auto& list) {
    using Entry = typename std::decay_t<decltype(list)>::value_type;
    std::vector<Offset> begin(ranks.size() + 1, static_cast<Offset>(list.size()));
    begin[0] = 0;
    const Array<Entry, HostMemory> entries(const_cast<Entry*>(list.data()), list.size());  // nobody writes to it
    return EntriesByRank<Entry>{entries, std::move(begin)};
  };
  return unpacked(ranks, label, send_lists(ranks, label, [&] { return std::make_tuple(for_first(lists)...); }));
}

/// What all ranks have of one list, likewise. Collective.
template <class T>
EntriesByRank<T> to_first(const Ranks& ranks, const char* label, const std::vector<T>& list) {
  return std::get<0>(lists_to_first(ranks, label, list));
}

/// What all ranks have of several lists, one rank after the other, on each of them. Collective.
template <class... T>
std::tuple<std::vector<T>...> lists_of_all(const Ranks& ranks, const char* label, const std::vector<T>&... lists) {
  const int here = ranks.rank();
  const auto own_of = [&](const auto& list) {
    using Entry = typename std::decay_t<decltype(list)>::value_type;
    std::vector<Offset> begin(ranks.size() + 1, 0);
    std::fill(begin.begin() + here + 1, begin.end(), static_cast<Offset>(list.size()));
    const Array<Entry, HostMemory> entries(const_cast<Entry*>(list.data()), list.size());  // nobody writes to it
    return EntriesByRank<Entry>{entries, std::move(begin)};
  };
  const auto own = std::make_tuple(own_of(lists)...);
  ReceivedBytes bytes = exchange_pieces(ranks, label, [&] {
    const PackedPieces packed =
        std::apply([&](const auto&... some) { return pack_lists({rows_of(some, here)...}); }, own);
    std::vector<PackedPieces> pieces(ranks.size(), packed);
    pieces[here].clear();
    return pieces;
  });
  const ReceivedLists<std::tuple<EntriesByRank<T>...>> received(here, own, std::move(bytes));
  std::tuple<std::vector<T>...> all;
  together(ranks, [&] {
    all = std::apply([](const auto&... some) { return std::make_tuple(vector_of(some.entries)...); },
                     received.unpack(label));
  });
  return all;
}

/// What the ranks answer to a question about each of the items 0..items-1, by item: what answer_all(questions, answers)
/// has the rank rank_of(i) write to the place that question_of(i) has among the questions' entries. Collective; no
/// answer_all sends anything.
template <class Answer, class RankOf, class QuestionOf, class AnswerAll>
Array<Answer, HostMemory> ask_for_all(const Ranks& ranks, const char* label, Offset items, const RankOf& rank_of,
                                      const QuestionOf& question_of, const AnswerAll& answer_all) {
  using Question = std::decay_t<decltype(question_of(Id()))>;
  Array<Id, HostMemory> members;
  const auto asked = send_lists(ranks, "GALE::questions", [&] {
    return std::make_tuple(
        entries_by_rank<Question>(ranks.size(), "GALE::asked", items, rank_of, question_of, &members));
  });
  const auto answered = send_lists(ranks, "GALE::answers", [&] {
    const auto [questions] = asked.unpack("GALE::questions");
    const auto given = room_by_rank<Answer>("GALE::answers", counts_of(questions));
    answer_all(questions, given.entries);
    return std::make_tuple(given);
  });
  Array<Answer, HostMemory> answers;
  together(ranks, [&] {
    const auto received = std::get<0>(answered.unpack("GALE::answered"));
    answers = allocate<Array<Answer, HostMemory>>(label, items);
    parallel_for(label, HostExecutionSpace(), items, [&](Offset k) { answers(members(k)) = received.entries(k); });
  });
  return answers;
}

/// What the ranks answer to each question by itself: answer_of(question_of(i)). Collective; no answer_of sends
/// anything.
template <class Answer, class RankOf, class QuestionOf, class AnswerOf>
Array<Answer, HostMemory> ask(const Ranks& ranks, const char* label, Offset items, const RankOf& rank_of,
                              const QuestionOf& question_of, const AnswerOf& answer_of) {
  return ask_for_all<Answer>(ranks, label, items, rank_of, question_of,
                             [&](const auto& questions, const auto& answers) {
                               parallel_for("GALE::answers", HostExecutionSpace(), questions.count(),
                                            [&](Offset i) { answers(i) = answer_of(questions.entries(i)); });
                             });
}

}  // namespace gale::detail
