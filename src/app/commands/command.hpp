#pragma once

#include <initializer_list>
#include <string>
#include <utility>

#include <gale/app/options/options.hpp>
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

  /// A command that runs an analysis, with its name and its help.
  Command(CLI::App& app, const outputs::Analysis& analysis, Works works = Works::on_one_rank)
      : Command(app, analysis.name, analysis.help, works) {}

  /// Where it adds options of its own.
  CLI::App& subcommand() { return subcommand_; }

  /// Adds a switch of an analysis: --name; where it is on by default, --no-name, which sets `is_on` to false.
  void add_flag(const outputs::AnalysisOption& option, bool& is_on);

  /// Adds --encoding, if it writes VTK's XML files.
  void add_encoding() { common_.add_encoding_to(subcommand_); }

  const InputOptions& input() const { return input_; }

  /// Throws UsageError, with its name, for an option that is given although there are several ranks: each pair says
  /// whether it is.
  static void refuse_on_ranks(std::initializer_list<std::pair<const char*, bool>> options);

  /// Throws UsageError unless `file`, the value of `option`, is empty or ends in one of `extensions`, in either case.
  void require_extension(const std::string& option, const std::string& file,
                         std::initializer_list<const char*> extensions) const;

  /// Throws UsageError unless `file` is empty or ends in .vtp or, on several ranks, in .pvtp.
  void require_points_extension(const std::string& option, const std::string& file) const;

 private:
  CLI::App& subcommand_;
  InputOptions input_;
  CommonOptions common_;
  Works works_;
};

}  // namespace gale::app
