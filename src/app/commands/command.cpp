#include <algorithm>
#include <cctype>

#include <CLI/CLI.hpp>

#include <gale/algorithms/critical_points.hpp>
#include <gale/app/commands/command.hpp>
#include <gale/app/drawing/drawer.hpp>
#include <gale/app/ranks/ranks.hpp>
#include <gale/io/bytes/text.hpp>

namespace gale::app {

namespace {

/// ".vtu, .vtk or .vtkhdf": the extensions that such results may have, and what is different on ranks.
std::string names_of(unsigned written, bool works_on_ranks) {
  const auto all = io::extensions_written(written), on_ranks = io::extensions_written(written, true);
  std::string names = all.back();
  if (all.size() > 1) names = io::detail::joined({all.begin(), all.end() - 1}, ", ") + " or " + names;
  if (!works_on_ranks || on_ranks == all) return names;
  const std::string& named = on_ranks.front();
  return names + "; on several ranks " + named + ", with a " + io::format_of('P' + named)->pieces + " a rank";
}

}  // namespace

Command::Command(CLI::App& app, const std::string& name, const std::string& what, Works works)
    : subcommand_(*app.add_subcommand(name, what)), works_(works) {
  input_.add_to(subcommand_);
  common_.add_to(subcommand_);
}

CLI::Option* Command::add_file(const std::string& option, std::string& file, std::string what, unsigned written) {
  files_.push_back({option.substr(option.find("--")), file, written});
  const auto place = what.find("{}");
  if (place != std::string::npos) what.replace(place, 2, names_of(written, works_ == Works::on_many_ranks));
  return subcommand_.add_option(option, file, what)->type_name("FILE");
}

void Command::add_render(std::string& file, const std::string& what) {
  add_file("--render", file, what, io::written_pictures)
      ->type_name("FILE" + io::extensions_written(io::written_pictures).front());
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
  const auto all = io::extensions_written(file.written, Launch::are_several());
  const auto is_its = [&](const std::string& extension) { return io::detail::has_extension(file.name, extension); };
  if (file.name.empty() || file.written == 0 || std::any_of(all.begin(), all.end(), is_its)) return;
  throw UsageError(file.option + ' ' + file.name + ": gale " + subcommand_.get_name() + " writes " +
                   io::detail::joined(all, " or "));
}

std::string Command::with_extension(const std::string& name, unsigned written, bool has_pieces) const {
  if (!common_.extension.empty()) return name + common_.extension;
  return name + io::extensions_written(written, has_pieces && Launch::are_several()).front();
}

Session Command::begin(const std::vector<std::string>& more, Session::Outputs outputs) const {
  std::vector<std::string> files = more;
  for (const File& file : files_) {
    require_extension(file);
    if (!file.name.empty() && file.written == io::written_pictures) {
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

double AnalysisCommand::threshold_for(const io::PointArray& field) const {
  if (!persistence_) return 0;
  try {
    return outputs::threshold_of(*persistence_, field, Launch::ranks());
  } catch (const Error& error) {
    const std::string what = std::string("--persistence: ") + error.what();
    if (Launch::are_several()) throw SharedError(what);  // all have the same range
    throw Error(what);
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
