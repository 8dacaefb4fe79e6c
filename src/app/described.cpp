#include <algorithm>
#include <vector>

#include <CLI/CLI.hpp>

#include <gale/app/commands/command.hpp>
#include <gale/io/bytes/text.hpp>
#include <gale/version.hpp>

namespace gale::app {

namespace {

using io::detail::joined;

/// An option or a positional argument, as it is typed.
struct Described {
  std::vector<std::string> names;    ///< with their dashes, the short one first; none of a positional argument
  std::string value;                 ///< what it takes, "FILE"; empty of a switch
  std::vector<std::string> choices;  ///< the words that the value is one of, if there are some
  std::string help;

  bool takes_file() const { return value == "INPUT" || value == "P" || value.rfind("FILE", 0) == 0; }
};

Described described(const CLI::Option& option) {
  Described one;
  for (const std::string& name : option.get_snames()) one.names.push_back('-' + name);
  for (const std::string& name : option.get_lnames()) one.names.push_back("--" + name);
  one.help = option.get_description();
  if (option.get_positional()) one.value = option.get_name(true);
  if (option.get_positional() || option.get_items_expected_max() == 0) return one;
  const std::string type = option.get_type_name();  // "TEXT:{a,b}" where it is one of these, "INT:INT in [1 - 9]"
  one.value = type.substr(0, type.find(':'));
  const auto begin = type.find('{'), end = type.find('}');
  if (begin == std::string::npos || end == std::string::npos) return one;
  for (const std::string& choice : CLI::detail::split(type.substr(begin + 1, end - begin - 1), ','))
    one.choices.push_back(choice);
  return one;
}

std::vector<Described> options_of(const CLI::App& app) {
  std::vector<Described> all;
  for (const CLI::Option* const option : app.get_options()) all.push_back(described(*option));
  return all;
}

std::vector<const CLI::App*> commands_of(const CLI::App& app) {
  return app.get_subcommands([](const CLI::App*) { return true; });
}

std::string replaced(std::string text, const std::string& from, const std::string& to) {
  for (std::size_t at = 0; (at = text.find(from, at)) != std::string::npos; at += to.size())
    text.replace(at, from.size(), to);
  return text;
}

/// Text that roff takes for nothing else.
std::string in_roff(const std::string& text) {
  const std::string safe = replaced(replaced(text, "\\", "\\e"), "-", "\\-");
  return safe.empty() || (safe[0] != '.' && safe[0] != '\'') ? safe : "\\&" + safe;
}

/// An entry of a list: its name, and what it is about.
std::string item(const std::string& name, const std::string& help) {
  return ".TP\n" + name + '\n' + in_roff(help) + '\n';
}

std::string items(const std::vector<Described>& options) {
  std::string text;
  for (const Described& one : options) {
    std::string name = "\\fB" + in_roff(joined(one.names, ", ")) + "\\fR";
    if (!one.value.empty())
      name += " \\fI" + in_roff(one.choices.empty() ? one.value : joined(one.choices, "|")) + "\\fR";
    text += item(one.names.empty() ? "\\fI" + one.value + "\\fR" : name, one.help);
  }
  return text;
}

/// Text between single quotes of a shell.
std::string quoted(const std::string& text) { return '\'' + replaced(text, "'", "'\\''") + '\''; }

/// A case of each option that takes a value, by the words or files that it may be.
std::string bash_values(const CLI::App& app) {
  std::string text;
  for (const Described& one : options_of(app)) {
    if (one.value.empty() || one.names.empty()) continue;
    std::string reply;
    if (!one.choices.empty())
      reply = "COMPREPLY=($(compgen -W '" + joined(one.choices, " ") + "' -- \"$current\")); ";
    else if (one.takes_file())
      reply = "_gale_files; ";
    text += "        " + joined(one.names, "|") + ") " + reply + "return ;;\n";
  }
  return text;
}

std::string in_bash(const CLI::App& app) {
  std::string cases, names;
  for (const CLI::App* const command : commands_of(app)) {
    std::string options;
    for (const Described& one : options_of(*command)) options += (options.empty() ? "" : " ") + joined(one.names, " ");
    names += (names.empty() ? "" : " ") + command->get_name();
    cases += "    " + command->get_name() + ")\n      case \"$before\" in\n" + bash_values(*command) +
             "      esac\n      options='" + options + "' ;;\n";
  }
  std::string first = names;
  for (const Described& one : options_of(app)) first += ' ' + joined(one.names, " ");
  return "# Completes gale's arguments in bash; made by gale --completions bash.\n"
         "_gale_files() {\n"
         "  compopt -o filenames 2>/dev/null\n"
         "  mapfile -t COMPREPLY < <(compgen -f -- \"$current\")\n"
         "}\n"
         "_gale() {\n"
         "  local current=${COMP_WORDS[COMP_CWORD]} before=${COMP_WORDS[COMP_CWORD - 1]} options=\n"
         "  COMPREPLY=()\n"
         "  if [ \"$COMP_CWORD\" -eq 1 ]; then\n"
         "    COMPREPLY=($(compgen -W '" +
         first +
         "' -- \"$current\"))\n"
         "    return\n"
         "  fi\n"
         "  case \"${COMP_WORDS[1]}\" in\n" +
         cases +
         "    *) return ;;\n"
         "  esac\n"
         "  if [ \"${current:0:1}\" = - ]; then\n"
         "    COMPREPLY=($(compgen -W \"$options\" -- \"$current\"))\n"
         "  else\n"
         "    _gale_files\n"
         "  fi\n"
         "}\n"
         "complete -F _gale gale\n";
}

/// An argument as zsh's _arguments takes it: names that exclude one another, what it is, and what it takes.
std::string zsh_argument(const Described& one) {
  const auto safe = [](const std::string& text) {
    return replaced(replaced(replaced(replaced(text, "\\", "\\\\"), "[", "\\["), "]", "\\]"), ":", "\\:");
  };
  const std::string values = !one.choices.empty() ? '(' + joined(one.choices, " ") + ')'
                             : one.takes_file()   ? "_files"
                                                  : " ";
  if (one.names.empty()) return quoted("1:" + safe(one.help) + ':' + values);
  const std::string what = '[' + safe(one.help) + ']' + (one.value.empty() ? "" : ':' + safe(one.value) + ':' + values);
  if (one.names.size() == 1) return quoted(one.names[0] + what);
  return quoted('(' + joined(one.names, " ") + ')') + '{' + joined(one.names, ",") + '}' + quoted(what);
}

std::string in_zsh(const CLI::App& app) {
  std::string cases, commands;
  for (const CLI::App* const command : commands_of(app)) {
    cases += "    " + command->get_name() + ")\n      _arguments -s";
    for (const Described& one : options_of(*command)) cases += " \\\n        " + zsh_argument(one);
    cases += " ;;\n";
    commands += "    " + quoted(command->get_name() + ':' + command->get_description()) + '\n';
  }
  std::string own;
  for (const Described& one : options_of(app)) own += ' ' + zsh_argument(one);
  return "#compdef gale\n"
         "# Completes gale's arguments in zsh; made by gale --completions zsh.\n"
         "_gale() {\n"
         "  local context state line\n"
         "  local -a commands\n"
         "  commands=(\n" +
         commands +
         "  )\n"
         "  _arguments -C" +
         own +
         " '1: :->command' '*:: :->arguments' && return\n"
         "  case $state in\n"
         "    command) _describe command commands; return ;;\n"
         "  esac\n"
         "  case $line[1] in\n" +
         cases +
         "  esac\n"
         "}\n"
         "_gale \"$@\"\n";
}

}  // namespace

std::string manual_page(const CLI::App& app) {
  std::string text = std::string(".TH GALE 1 \"\" \"gale ") + version + "\" \"User Commands\"\n.SH NAME\ngale \\- " +
                     in_roff(app.get_description()) +
                     "\n.SH SYNOPSIS\n.B gale\n.I COMMAND INPUT\n[\\fIoptions\\fR]\n.SH OPTIONS\n" +
                     items(options_of(app)) + ".SH COMMANDS\n";
  for (const CLI::App* const command : commands_of(app))
    text += item("\\fB" + in_roff(command->get_name()) + "\\fR", command->get_description() + '.');
  for (const CLI::App* const command : commands_of(app)) {
    std::string heading = command->get_name();
    std::transform(heading.begin(), heading.end(), heading.begin(), [](unsigned char c) { return std::toupper(c); });
    text += ".SH GALE " + in_roff(heading) + '\n' + in_roff(command->get_description()) + ".\n" +
            items(options_of(*command));
  }
  return text + ".SH EXIT STATUS\n" + item("0", "Done.") +
         item("1", "It failed, and standard error has one line that says what and where.") + item("2", "Wrong usage.");
}

std::string completions(const CLI::App& app, const std::string& shell) {
  return shell == "zsh" ? in_zsh(app) : in_bash(app);
}

}  // namespace gale::app
