#include <algorithm>
#include <atomic>
#include <ostream>

#include <CLI/CLI.hpp>

#include <gale/app/commands/command.hpp>
#include <gale/base/error.hpp>
#include <gale/baselines/oracle.hpp>
#include <gale/runtime/relation_of.hpp>

namespace gale::app {

namespace {

/// How large a relation is.
struct RelationSize {
  std::int64_t rows = 0, entries = 0;
  Id longest = 0;

  void add(const Row& row) {
    ++rows;
    entries += row.size();
    longest = std::max(longest, row.size());
  }
  void add(const RelationSize& other) {
    rows += other.rows;
    entries += other.entries;
    longest = std::max(longest, other.longest);
  }
};

/// Calls visit(consumer, simplex, row) for every row.
template <class Visit>
void for_each_row(Structure& structure, Relation relation, const SweepOptions& sweep, const Visit& visit) {
  const int dimension = row_dimension(relation);
  structure.for_each_segment(relation, sweep, [&](int consumer, const SegmentRows& rows) {
    for (const Id simplex : rows.interval(dimension)) visit(consumer, simplex, rows[relation][simplex]);
  });
}

RelationSize measure(Structure& structure, Relation relation, const SweepOptions& sweep) {
  struct alignas(64) Slot {
    RelationSize sizes;
  };
  std::vector<Slot> slots(sweep.threads);
  for_each_row(structure, relation, sweep, [&](int consumer, Id, const Row& row) { slots[consumer].sizes.add(row); });
  RelationSize all;
  for (const Slot& slot : slots) all.add(slot.sizes);
  return all;
}

/// How many rows differ from the oracle's, are missing, or are too many.
std::int64_t count_differences(Structure& structure, Relation relation, baselines::Oracle& oracle,
                               const SweepOptions& sweep) {
  std::atomic<std::int64_t> same{0}, more{0};
  std::vector<std::vector<Id>> expected(sweep.threads);
  for_each_row(structure, relation, sweep, [&](int consumer, Id simplex, const Row& row) {
    if (simplex >= oracle.rows()) {
      ++more;
      return;
    }
    auto& right = expected[consumer];
    oracle.read(simplex, consumer, right);
    if (std::equal(row.begin(), row.end(), right.begin(), right.end())) ++same;
  });
  return oracle.rows() - same + more;
}

/// Writes all rows, in input ids.
void write_rows(std::ostream& out, const Mesh& mesh, Relation relation) {
  const auto rows = relation_of(mesh, relation, Ids::input);
  out << "# " << name_of(relation) << ": " << rows.rows() << " rows, " << rows.entries.extent(0) << " entries\n";
  for (Offset i = 0; i < rows.rows(); ++i) {
    out << i << ':';
    for (const Id entry : rows.row(i)) out << ' ' << entry;
    out << '\n';
  }
}

void tell(const RelationSize& sizes, Relation relation, Session& session) {
  const double run = session.report().seconds.run, entries = static_cast<double>(sizes.entries),
               rows = static_cast<double>(sizes.rows);
  session.tell("relation", "relation", name_of(relation));
  session.tell("rows", "rows", sizes.rows);
  session.tell("entries", "entries", sizes.entries);
  session.tell("longest row", "longest_row", sizes.longest);
  const auto rate = [&](double amount, const char* unit) {
    return formatted("%.1f %s", run > 0 ? amount / run : 0, unit);
  };
  session.console().say("rates", rate(rows / 1e6, "M rows/s, ") + rate(entries / 1e6, "M entries/s, ") +
                                     rate((entries + rows) * sizeof(Id) / 1e9, "GB/s"));
}

/// Compares all rows with an oracle that shares no code with the structure.
void verify(Structure& structure, Relation relation, bool is_explicit, const RelationSize& sizes, Session& session) {
  const SweepOptions sweep = session.sweep("verifying " + name_of(relation));
  const auto oracle = baselines::make_oracle(structure.mesh(), relation, sweep.threads, is_explicit);
  const std::int64_t differences = count_differences(structure, relation, *oracle, sweep);
  session.console().say("differences", grouped(differences) + " from " + oracle->name());
  session.report().result["differences"] = differences;
  if (differences != 0) {
    throw Error(std::to_string(differences) + " of " + std::to_string(sizes.rows) + " rows of " + name_of(relation) +
                " differ from " + oracle->name());
  }
}

class ComputeRelation final : public Command {
 public:
  explicit ComputeRelation(CLI::App& app)
      : Command(app, "relations", "Computes a relation of the whole mesh: its size, and how fast it comes") {
    segmentation_.add_to(subcommand());
    structure_.add_to(subcommand());
    std::vector<std::string> names;
    for (const Relation relation : members_of(all_relations)) names.push_back(name_of(relation));
    subcommand()
        .add_option("--relation", relation_,
                    "XY: for each X the Ys that touch it; V vertex, E edge, F triangle, T tetrahedron")
        ->required()
        ->check(CLI::IsMember(names));
    subcommand().add_flag("--verify", verify_,
                          "Compare every row with the explicit structure (with brute force if it is that one, or "
                          "without Kokkos-Kernels)");
    add_file("--dump", dump_, "Write all rows to this text file");
  }

  void run() const override {
    Session session = begin();
    const Relation relation = *relation_named(relation_);
    io::Dataset dataset = session.read();
    const Mesh mesh = session.encode(dataset, segmentation_, Session::Keep::nothing);
    const auto structure = session.make_structure(structure_, mesh, relation);
    const RelationSize sizes = timed(session.report().seconds.run, [&] {
      return measure(*structure, relation, session.sweep("sweeping " + name_of(relation)));
    });
    tell(sizes, relation, session);
    if (verify_) verify(*structure, relation, structure_.is_explicit(), sizes, session);
    session.write(dump_, [&](const io::AtomicFile& file) {
      write_text(file, [&](std::ostream& out) { write_rows(out, mesh, relation); });
    });
    session.finish(structure.get());
  }

 private:
  SegmentationOptions segmentation_;
  StructureOption structure_;
  std::string relation_;  ///< the name of one of the sixteen
  bool verify_ = false;
  std::string dump_;
};

}  // namespace

std::unique_ptr<Command> add_relations(CLI::App& app) { return std::make_unique<ComputeRelation>(app); }

}  // namespace gale::app
