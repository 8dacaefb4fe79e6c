#pragma once

#include <string>

namespace CLI {
class App;
}

// What the command line takes, for readers and shells: made from the options themselves, so that nothing can be left
// out.

namespace gale::app {

/// The manual page, section 1, as roff.
std::string manual_page(const CLI::App& app);

/// A script that completes the command's arguments in "bash" or "zsh": commands, options, the words of an option that
/// takes one of some, and files.
std::string completions(const CLI::App& app, const std::string& shell);

}  // namespace gale::app
