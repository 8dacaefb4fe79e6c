#include <algorithm>
#include <cctype>

#include <CLI/CLI.hpp>

#include <gale/app/commands/command.hpp>
#include <gale/app/ranks/ranks.hpp>
#include <gale/app/usage_error.hpp>

namespace gale::app {

Command::Command(CLI::App& app, const std::string& name, const std::string& what, Works works)
    : subcommand_(*app.add_subcommand(name, what)), works_(works) {
  input_.add_to(subcommand_);
  common_.add_to(subcommand_);
}

void Command::add_flag(const outputs::AnalysisOption& option, bool& is_on) {
  std::string name = option.name, help = option.help;
  std::replace(name.begin(), name.end(), '_', '-');
  if (option.is_on) {
    help[0] = static_cast<char>(std::tolower(static_cast<unsigned char>(help[0])));
    subcommand_.add_flag_callback(
        "--no-" + name, [&is_on] { is_on = false; }, "Without " + help);
  } else {
    subcommand_.add_flag("--" + name, is_on, help);
  }
}

bool Command::is_chosen() const { return subcommand_.parsed(); }

namespace {

/// In either case; more than the extension alone.
bool ends_in(const std::string& file, const std::string& extension) {
  return file.size() > extension.size() && std::equal(extension.rbegin(), extension.rend(), file.rbegin(),
                                                      [](char a, unsigned char b) { return a == std::tolower(b); });
}

}  // namespace

void Command::require_ranks() const {
  if (works_ == Works::on_many_ranks || !Launch::are_several()) return;
  throw UsageError("gale " + subcommand_.get_name() + " works on one rank: start it without a launcher");
}

void Command::refuse_on_ranks(std::initializer_list<std::pair<const char*, bool>> options) {
  for (const auto& [option, is_given] : options) {
    if (is_given && Launch::are_several()) throw UsageError(std::string(option) + ": not on several ranks");
  }
}

void Command::require_points_extension(const std::string& option, const std::string& file) const {
  require_extension(option, file, {Launch::are_several() ? ".pvtp" : ".vtp"});
}

void Command::require_extension(const std::string& option, const std::string& file,
                                std::initializer_list<const char*> extensions) const {
  if (file.empty()) return;
  std::string list;
  for (const std::string extension : extensions) {
    if (ends_in(file, extension)) return;
    list += (list.empty() ? "" : " or ") + extension;
  }
  throw UsageError(option + ' ' + file + ": gale " + subcommand_.get_name() + " writes " + list);
}

}  // namespace gale::app
