#pragma once

#include <array>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <gale/app/options.hpp>
#include <gale/app/session.hpp>
#include <gale/io/formats.hpp>
#include <gale/outputs/analyses.hpp>

namespace gale::app {

/// A subcommand: its options, which its constructor adds to the command line, and what it does with them.
class Command {
 public:
  virtual ~Command() = default;

  /// Does what the command is for; to be called when the command line has been parsed and Kokkos is initialized. Throws
  /// gale::Error or UsageError.
  virtual void run() const = 0;

  /// Throws UsageError if it was started on several ranks, and works on one alone.
  void require_ranks() const;

  /// Whether the command line names it.
  bool is_chosen() const;

  const CommonOptions& common() const { return common_; }

 protected:
  /// `what` it does is for the help. `app` must outlive the command.
  enum class Works { on_one_rank, on_many_ranks };
  Command(CLI::App& app, const std::string& name, const std::string& what, Works works = Works::on_one_rank);

  /// Where it adds options of its own.
  CLI::App& subcommand() { return subcommand_; }

  /// Adds an option that names a file to write results of these kinds to, bits of io::Written, of an extension that
  /// they may have, or of any: 0. `what` is the help's text, in which {} becomes these extensions. Empty where it isn't
  /// given. Returns the option.
  CLI::Option* add_file(const std::string& option, std::string& file, std::string what, unsigned written = 0);

  /// Adds --render, which names a picture.
  void add_render(std::string& file, const std::string& what);

  /// Adds --encoding, if it writes VTK's XML files.
  void add_encoding() { common_.add_encoding_to(subcommand_); }

  /// Adds --format, if it gives its files their extensions itself.
  void add_format() { common_.add_format_to(subcommand_); }

  /// What a file of such results is called, of pieces on several ranks if it `has_pieces`, unless --format says
  /// otherwise.
  std::string with_extension(const std::string& name, unsigned written, bool has_pieces = true) const;

  /// Throws UsageError for a --format that isn't written by several ranks.
  void require_format() const { refuse_on_ranks({{"--format vtkhdf", !common_.extension.empty()}}); }

  /// Has it take a series, and --times, if it goes through its steps.
  void add_times() { input_.add_times_to(subcommand_); }

  const InputOptions& input() const { return input_; }

  /// The session of a run, which writes the files that options name, and `more`. Throws UsageError for a file of
  /// another extension, gale::Error for a .png that can't be drawn here, and as Session does.
  Session begin(const std::vector<std::string>& more = {},
                Session::Outputs outputs = Session::Outputs::of_each_step) const;

  /// Throws UsageError, with its name, for an option that is given although there are several ranks: each pair says
  /// whether it is.
  static void refuse_on_ranks(std::initializer_list<std::pair<const char*, bool>> options);

 private:
  struct File {
    std::string option;
    const std::string& name;
    unsigned written;
  };
  void require_extension(const File& file) const;

  CLI::App& subcommand_;
  InputOptions input_;
  CommonOptions common_;
  std::vector<File> files_;
  Works works_;
};

/// A command that runs an analysis of a field, with its name, its help and its options.
class AnalysisCommand : public Command {
 public:
  void run() const final;

 protected:
  explicit AnalysisCommand(CLI::App& app, const std::string& name, Works works = Works::on_one_rank)
      : AnalysisCommand(app, outputs::analysis_named(name), works) {}

  /// The command of this description, which must outlive it.
  explicit AnalysisCommand(CLI::App& app, const outputs::Analysis& analysis, Works works = Works::on_one_rank);

  /// Adds a switch of the analysis: --name; where it is on by default, --no-name, which sets `is_on` to false.
  void add_flag(const std::string& name, bool& is_on);

  /// Adds the analysis's --persistence.
  void add_persistence() { app::add_persistence(subcommand(), persistence_, analysis_.option("persistence").help); }

  /// What --persistence says of a field on all ranks, as a difference of its values; 0 if it isn't given. Names the
  /// option in what goes wrong. Collective.
  double threshold_for(const io::PointArray& field) const;

  /// Throws UsageError or gale::Error for what the command line says together and can't; before anything is read.
  virtual void require_usage() const {}

  /// The names of files beside those that options name, each empty where it isn't wanted.
  virtual std::vector<std::string> more_files() const { return {}; }

  /// Whether the session keeps the dataset's cells.
  virtual Session::Keep keep() const { return Session::Keep::nothing; }

  /// Has the device do on a tiny mesh what it will do on the input.
  virtual void warm_up(const VertexOrder& order) const { find_discrete_gradient(order); }

  /// Finds, says and writes what the analysis is about, in a step.
  virtual void analyse(const FieldOnMesh& /*on*/, Session& /*session*/, Computed& /*computed*/) const {}

  /// What the files are of that it writes.
  virtual Session::Outputs outputs() const { return Session::Outputs::of_each_step; }

  /// Reads and analyses each step by itself.
  virtual void go_through_steps(Session& session, Computed& computed) const;

  const outputs::Analysis& analysis_;
  SegmentationOptions segmentation_;
  StructureOption structure_;
  std::optional<outputs::Persistence> persistence_;
};

/// Says and reports how many critical points there are, by CriticalType but `regular`. Where cells are of dimension 2,
/// `top`, there are saddles of one kind.
void tell_types(const std::array<std::int64_t, 5>& counts, int top, Session& session);

/// Says and reports how many critical simplices there are, by dimension, up to the cells' (`top`).
void tell_simplices(const std::array<std::int64_t, 4>& counts, int top, Session& session);

// Each adds its subcommand to the command line, which must outlive it.
std::unique_ptr<Command> add_info(CLI::App& app);
std::unique_ptr<Command> add_segment(CLI::App& app);
std::unique_ptr<Command> add_critical_points(CLI::App& app);
std::unique_ptr<Command> add_discrete_gradient(CLI::App& app);
std::unique_ptr<Command> add_morse_smale(CLI::App& app);
std::unique_ptr<Command> add_persistence_diagram(CLI::App& app);
std::unique_ptr<Command> add_merge_tree(CLI::App& app);
std::unique_ptr<Command> add_simplify_field(CLI::App& app);
std::unique_ptr<Command> add_track(CLI::App& app);
std::unique_ptr<Command> add_relations(CLI::App& app);
std::unique_ptr<Command> add_generate(CLI::App& app);

// What the command line takes, for readers and shells: made from the options themselves, so that nothing can be left
// out.

/// The manual page, section 1, as roff.
std::string manual_page(const CLI::App& app);

/// A script that completes the command's arguments in "bash" or "zsh": commands, options, the words of an option that
/// takes one of some, and files.
std::string completions(const CLI::App& app, const std::string& shell);

/// The analyses and tracking, their options and results (outputs/analyses.hpp), as JSON.
std::string analyses_as_json();

/// The table of all subcommands, in the order of the help.
using AddCommand = std::unique_ptr<Command> (*)(CLI::App& app);
inline constexpr AddCommand all_commands[] = {add_info,
                                              add_segment,
                                              add_critical_points,
                                              add_discrete_gradient,
                                              add_morse_smale,
                                              add_persistence_diagram,
                                              add_merge_tree,
                                              add_simplify_field,
                                              add_track,
                                              add_relations,
                                              add_generate};

}  // namespace gale::app
