#pragma once

#include <string>

#include <gale/export.hpp>

namespace gale::io::detail {

/// Finds a program or a module that GALE has beside the program, library or Python module that holds this code, or
/// where GALE was installed; `access` is to be allowed, R_OK or X_OK of <unistd.h>. Throws gale::Error if it isn't
/// there:
/// "`use` by `name`, which isn't beside ... nor in ...: it is built `origin`".
GALE_EXPORT std::string find_installed(const std::string& name, int access, const char* use, const char* origin);

}  // namespace gale::io::detail
