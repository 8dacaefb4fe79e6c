#include <algorithm>
#include <cctype>

#include <CLI/CLI.hpp>

#include <gale/algorithms/critical_points.hpp>
#include <gale/app/commands/command.hpp>
#include <gale/app/drawing/drawer.hpp>
#include <gale/app/ranks/ranks.hpp>
#include <gale/io/bytes/text.hpp>

namespace gale::app {

Command::Command(CLI::App& app, const std::string& name, const std::string& what, Works works)
    : subcommand_(*app.add_subcommand(name, what)), works_(works) {
  input_.add_to(subcommand_);
  common_.add_to(subcommand_);
}

CLI::Option* Command::add_file(const std::string& option, std::string& file, const std::string& what,
                               const std::vector<std::string>& extensions) {
  files_.push_back({option.substr(option.find("--")), file, extensions});
  return subcommand_.add_option(option, file, what)->type_name("FILE");
}

bool Command::is_chosen() const { return subcommand_.parsed(); }

void Command::require_ranks() const {
  if (works_ == Works::on_many_ranks || !Launch::are_several()) return;
  throw UsageError("gale " + subcommand_.get_name() + " works on one rank: start it without a launcher");
}

void Command::refuse_on_ranks(std::initializer_list<std::pair<const char*, bool>> options) {
  for (const auto& [option, is_given] : options) {
    if (is_given && Launch::are_several()) throw UsageError(std::string(option) + ": not on several ranks");
  }
}

void Command::require_extension(const File& file) const {
  if (file.name.empty() || file.extensions.empty()) return;
  std::string list;
  for (std::string extension : file.extensions) {
    if (Launch::are_several() && file.extensions.front() == ".vtp") {
      if (extension == ".vtkhdf") continue;  // that format has no pieces
      extension = ".pvtp";
    }
    if (io::detail::has_extension(file.name, extension)) return;
    list += (list.empty() ? "" : " or ") + extension;
  }
  throw UsageError(file.option + ' ' + file.name + ": gale " + subcommand_.get_name() + " writes " + list);
}

std::string Command::with_extension(const std::string& name, const char* extension, bool has_pieces) const {
  if (common_.is_vtkhdf) return name + ".vtkhdf";
  return name + (has_pieces && Launch::are_several() ? ".p" : ".") + extension;
}

Session Command::begin(const std::vector<std::string>& more, Session::Outputs outputs) const {
  std::vector<std::string> files = more;
  for (const File& file : files_) {
    require_extension(file);
    if (!file.name.empty() && file.extensions == std::vector<std::string>{".png"}) {
      detail::together(Launch::ranks(), [] {
        if (Launch::is_first()) require_drawing();  // which draws for all
      });
    }
    files.push_back(file.name);
  }
  return Session(input_, common_, files, outputs);
}

AnalysisCommand::AnalysisCommand(CLI::App& app, const outputs::Analysis& analysis, Works works)
    : Command(app, analysis.name, analysis.help, works), analysis_(analysis) {
  segmentation_.add_to(subcommand());
  structure_.add_to(subcommand());
  structure_.add_consumers_to(subcommand());
  add_encoding();
  add_times();
}

void AnalysisCommand::add_flag(const std::string& name, bool& is_on) {
  std::string option = name, help = analysis_.option(name).help;
  std::replace(option.begin(), option.end(), '_', '-');
  if (analysis_.option(name).is_on) {
    help[0] = static_cast<char>(std::tolower(static_cast<unsigned char>(help[0])));
    subcommand().add_flag_callback(
        "--no-" + option, [&is_on] { is_on = false; }, "Without " + help);
  } else {
    subcommand().add_flag("--" + option, is_on, help);
  }
}

void AnalysisCommand::run() const {
  structure_.require_consumers();
  require_usage();
  Session session = begin(more_files(), outputs());
  session.warm_up(structure_, [this](const VertexOrder& order) { warm_up(order); });
  Computed computed;
  go_through_steps(session, computed);
  session.finish(structure_, computed);
}

void AnalysisCommand::go_through_steps(Session& session, Computed& computed) const {
  do {
    const FieldOnMesh on = session.read_field(segmentation_, keep());
    analyse(on, session, computed);
  } while (session.next_step(computed));
}

void tell_types(const std::array<std::int64_t, 5>& counts, int top, Session& session) {
  const struct {
    CriticalType type;
    const char *name, *key;
  } kinds[] = {{CriticalType::minimum, "minima", "minima"},
               {CriticalType::saddle1, top == 3 ? "1-saddles" : "saddles", "saddles1"},
               {CriticalType::saddle2, "2-saddles", "saddles2"},
               {CriticalType::maximum, "maxima", "maxima"},
               {CriticalType::degenerate, "degenerate", "degenerate"}};
  for (const auto& kind : kinds) {
    const std::int64_t count = counts[static_cast<int>(kind.type)];
    session.report().result[kind.key] = count;
    if (top == 3 || kind.type != CriticalType::saddle2) session.console().say(kind.name, grouped(count));
  }
}

void tell_simplices(const std::array<std::int64_t, 4>& counts, int top, Session& session) {
  const auto names =
      top == 3 ? std::vector{"minima", "1-saddles", "2-saddles", "maxima"} : std::vector{"minima", "saddles", "maxima"};
  for (std::size_t dimension = 0; dimension < names.size(); ++dimension)
    session.console().say(names[dimension], grouped(counts[dimension]));
  const std::int64_t euler = counts[0] - counts[1] + counts[2] - counts[3];
  session.console().say("Euler number", grouped(euler));
  session.report().result = {{"critical", counts}, {"euler", euler}};
}

}  // namespace gale::app
