#include <cstdio>
#include <cstdlib>
#include <exception>
#include <iostream>
#include <map>
#include <string>

#include <Kokkos_Core.hpp>

#include <gale/app/commands/commands.hpp>
#include <gale/app/machine.hpp>
#include <gale/base/memory.hpp>
#include <gale/base/threads.hpp>

namespace {

enum ExitCode { done = 0, failed = 1, wrong_usage = 2 };

/// One line, whatever the message.
int complain(ExitCode code, std::string what) {
  for (char& c : what) {
    if (c == '\n' || c == '\r') c = ' ';
  }
  std::fprintf(stderr, "gale: %s\n", what.c_str());
  return code;
}

void run(const gale::app::Options& options) {
  static const std::map<std::string, void (*)(const gale::app::Options&)> commands = {
      {"info", gale::app::info},
      {"segment", gale::app::segment},
      {"critical-points", gale::app::critical_points},
      {"discrete-gradient", gale::app::discrete_gradient},
      {"morse-smale", gale::app::morse_smale},
      {"relations", gale::app::relations},
      {"generate", gale::app::generate}};
  if (options.threads) gale::set_host_threads(*options.threads);
  setenv("KOKKOS_DISABLE_WARNINGS", "1", 0);  // such as on thread binding, which is not what standard error is for
  const Kokkos::ScopeGuard kokkos;
  gale::app::watch_device_memory();
  commands.at(options.command)(options);
}

/// Whether all that went to standard output has arrived: a disk may be full, a descriptor closed.
bool output_arrived() { return std::cout.flush() && std::fflush(stdout) == 0 && std::ferror(stdout) == 0; }

}  // namespace

int main(int argc, char** argv) {
  try {
    const auto options = gale::app::parse_command_line(argc, argv);
    if (options) run(*options);
    return output_arrived() ? done : complain(failed, "cannot write to standard output");
  } catch (const gale::app::UsageError& error) {
    return complain(wrong_usage, error.what());
  } catch (const std::bad_alloc&) {
    return complain(failed, "out of memory");
  } catch (const std::exception& error) {
    return complain(failed, error.what());
  }
}
