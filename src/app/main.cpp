#include <fcntl.h>
#include <unistd.h>

#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <memory>
#include <new>
#include <stdexcept>
#include <string>
#include <system_error>
#include <vector>

#include <CLI/CLI.hpp>
#include <Kokkos_Core.hpp>

#include <gale/app/commands/command.hpp>
#include <gale/app/console.hpp>
#include <gale/app/machine.hpp>
#include <gale/app/ranks/ranks.hpp>
#include <gale/base/configuration.hpp>
#include <gale/base/memory.hpp>
#include <gale/base/threads.hpp>
#include <gale/io/atomic_file.hpp>
#include <gale/io/bytes/text.hpp>

namespace {

using gale::app::Command;
using gale::app::UsageError;
using gale::io::detail::joined;

enum ExitCode { done = 0, failed = 1, wrong_usage = 2 };

/// Prints one line, whatever the message; without memory.
int complain(ExitCode code, const char* what) {
  if (gale::app::Launch::all_fail_alike() && !gale::app::Launch::is_first()) return code;
  char line[4096];
  std::snprintf(line, sizeof line, "%s", what);
  for (char& c : line) {
    if (c == '\n' || c == '\r') c = ' ';
  }
  std::fprintf(stderr, "gale: %s\n", line);
  return code;
}

/// For errors that don't say where they happened.
int complain_of_step(const char* what, const char* advice) {
  char text[1024];
  std::snprintf(text, sizeof text, "%s while %s: %s", what, gale::app::current_step(), advice);
  return complain(failed, text);
}

int complain_of_memory() {
  return complain_of_step("out of memory", "try a machine with more, fewer --threads, or a smaller input");
}

/// Says what the exception that is being handled says.
int complain_of_exception() {
  if (gale::app::steps_ended()) return done;
  try {
    throw;
  } catch (const UsageError& error) {
    return complain(wrong_usage, error.what());
  } catch (const std::bad_alloc&) {
    return complain_of_memory();
  } catch (const std::length_error&) {  // more than a container can ever hold
    return complain_of_memory();
  } catch (const std::system_error& error) {
    return complain_of_step(error.what(), "the system lets this process have no more of that");
  } catch (const std::exception& error) {
    return complain(failed, error.what());
  } catch (...) {
    return complain_of_step("it failed", "for no reason that is known");
  }
}

/// For exceptions after which nothing more may run: while Kokkos is initialized (it may not survive its own end where
/// there is no more memory, and objects of its backends speak up where it isn't ended), or where they leave what
/// nothing may leave, as in libraries that don't expect memory to run out.
[[noreturn]] void end_by_exception() {
  gale::io::remove_temporary_files();
  const int code =
      std::current_exception() ? complain_of_exception() : complain_of_step("it failed", "it stopped itself");
  std::fflush(stdout);
  gale::app::Launch::end_all(code, gale::app::Launch::all_fail_alike());
  std::_Exit(code);
}

/// Has standard input, output and error take their descriptors where the parent process closed them: else the first
/// files that are opened would, and what is printed would be written to these. Writing to such an output fails.
void take_standard_descriptors() {
  for (int descriptor = open("/dev/null", O_RDONLY); descriptor >= 0; descriptor = dup(descriptor)) {
    if (descriptor <= STDERR_FILENO) continue;
    close(descriptor);
    return;
  }
}

/// Temporary files go with the process, however it ends; a limit of the size of files is an error like a full disk.
void prepare_for_the_end() {
  gale::io::remove_temporary_files_at_end();
  std::signal(SIGXFSZ, SIG_IGN);
  std::set_terminate(end_by_exception);
}

/// The answer to --version.
std::string what_this_is() {
  const gale::Configuration is = gale::configuration();
  return "gale " + is.version + "\ncommit " + (is.commit.empty() ? "unknown" : is.commit) + "\nKokkos " + is.kokkos +
         ": " + joined(is.backends, ", ") + "\nwith " + joined(is.options, ", ") + "\nby " + is.compiler;
}

std::string commands_of(const CLI::App& app) {
  std::string names;
  for (const CLI::App* const command : app.get_subcommands([](const CLI::App*) { return true; }))
    names += (names.empty() ? "" : ", ") + command->get_name();
  return "the commands are " + names;
}

/// What is wrong where no command was recognized.
std::string without_command(const CLI::App& app, int argc, char** argv) {
  const std::string first = argc > 1 ? argv[1] : "";
  if (first.empty()) return "no command: " + commands_of(app);
  if (first[0] == '-') return "no command before '" + first + "': " + commands_of(app);
  return "unknown command '" + first + "': " + commands_of(app);
}

/// Throws UsageError for an argument that is nothing, as that of a variable that isn't set: it would count as one that
/// isn't there.
void require_arguments(int argc, char** argv) {
  for (int i = 2; i < argc; ++i) {
    const std::string text = argv[i], before = argv[i - 1];
    const bool is_option = text.rfind("--", 0) == 0 && text.find('=') == text.size() - 1;
    if (is_option) throw UsageError(text.substr(0, text.size() - 1) + ": there is nothing after '='");
    if (text.empty()) throw UsageError(before[0] == '-' ? before + ": '' is nothing" : "'' is no argument");
  }
}

/// Parses the command line into the options of the command that it names. False if it only asked for help or the
/// version, which are printed then. Throws UsageError.
bool parse(CLI::App& app, int argc, char** argv) {
  require_arguments(argc, argv);
  try {
    app.parse(argc, argv);
    return true;
  } catch (const CLI::Success& success) {
    if (gale::app::Launch::is_first()) app.exit(success);
    return false;
  } catch (const CLI::ParseError& error) {
    const bool is_about_option = argc > 1 && app.get_option_no_throw(argv[1]) != nullptr;
    throw UsageError(app.get_subcommands().empty() && !is_about_option ? without_command(app, argc, argv)
                                                                       : error.what());
  }
}

void run(const Command& command) {
  command.require_ranks();
  if (command.common().threads) {
    gale::set_host_threads(*command.common().threads);
  } else if (gale::app::Launch::are_several()) {
    gale::set_host_threads(gale::app::Launch::threads(gale::host_threads()));
  }
  gale::app::require_threads(gale::host_threads());
  setenv("KOKKOS_DISABLE_WARNINGS", "1", 0);  // such as on thread binding, which is not what standard error is for
  const Kokkos::ScopeGuard kokkos(gale::initialization_arguments(gale::host_threads()));
  gale::app::watch_device_memory();
  try {
    command.run();
  } catch (...) {
    end_by_exception();
  }
}

void run(int argc, char** argv) {
  CLI::App app("Topological analysis of large tetrahedral meshes", "gale");
  app.set_version_flag("--version", what_this_is, "Print the version and what it was built with, and exit");
  const auto print = [](const std::string& text) {
    if (gale::app::Launch::is_first()) std::fputs(text.c_str(), stdout);
    throw CLI::Success();
  };
  app.add_flag_callback(
         "--analyses", [&] { print(gale::app::analyses_as_json() + '\n'); },
         "Print what the analyses are, their options and results, as JSON")
      ->trigger_on_parse();
  app.add_flag_callback(
         "--manual", [&] { print(gale::app::manual_page(app)); }, "Print the manual page, for man --local-file -")
      ->trigger_on_parse();
  app.add_option_function<std::string>(
         "--completions", [&](const std::string& shell) { print(gale::app::completions(app, shell)); },
         "Print a script that completes arguments in this shell")
      ->check(CLI::IsMember({"bash", "zsh"}))
      ->trigger_on_parse();
  app.require_subcommand(1);
  std::vector<std::unique_ptr<Command>> commands;
  for (const gale::app::AddCommand add : gale::app::all_commands) commands.push_back(add(app));
  app.footer(
      "What makes it fast: write only what you look at (--no-ascending-segmentation, --no-saddle-connectors and their "
      "like), give all steps of a series to one command, keep --mesh computed and --encoding appended. --report FILE "
      "says where the time went.");
  if (!parse(app, argc, argv)) return;
  for (const auto& command : commands) {
    if (command->is_chosen()) run(*command);
  }
}

/// The exit code of a run. What went wrong is said here, while the first rank still has the others wait for it: mpirun
/// ends all as soon as one has failed. A rank that fails alone ends the others, which may wait for it.
int run_and_say(int argc, char** argv) {
  try {
    gale::app::Launch::require_same_arguments(argc, argv);
    run(argc, argv);
    gale::app::require_output();
    return done;
  } catch (...) {
    if (!gale::app::Launch::all_fail_alike()) end_by_exception();
    return complain_of_exception();
  }
}

}  // namespace

int main(int argc, char** argv) {
  try {
    take_standard_descriptors();
    prepare_for_the_end();
    const gale::app::Launch launch(argc, argv);
    return run_and_say(argc, argv);
  } catch (...) {
    return complain_of_exception();
  }
}
