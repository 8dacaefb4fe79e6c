#include <algorithm>
#include <string>

#include <gtest/gtest.h>

#include <gale/base/configuration.hpp>
#include <gale/base/kokkos.hpp>
#include <gale/version.hpp>

namespace gale {
namespace {

TEST(Configuration, IsThatOfTheHeaders) {
  const Configuration is = configuration();
  EXPECT_EQ(is.version, version);
  EXPECT_EQ(is.kokkos, kokkos_version());
  EXPECT_TRUE(is.commit.empty() || is.commit.size() == 40) << is.commit;
  EXPECT_EQ(is.commit.find_first_not_of("0123456789abcdef"), std::string::npos) << is.commit;
}

TEST(Configuration, NamesTheWorkersBackend) {
  const Configuration is = configuration();
  EXPECT_NE(std::find(is.backends.begin(), is.backends.end(), WorkerSpace::name()), is.backends.end());
}

TEST(Configuration, SaysWhatTheTestWasBuiltWith) {
  const Configuration is = configuration();
  const auto names = [&](const char* what) {
    for (const std::string& one : is.options) {
      if (one.rfind(what, 0) == 0) return true;
    }
    return false;
  };
#ifdef GALE_ENABLE_VTK
  EXPECT_TRUE(names("VTK "));
#else
  EXPECT_FALSE(names("VTK "));
#endif
#ifdef GALE_ENABLE_KOKKOS_KERNELS
  EXPECT_TRUE(names("Kokkos-Kernels"));
#else
  EXPECT_FALSE(names("Kokkos-Kernels"));
#endif
#ifdef __VERSION__
  const std::string compiler = __VERSION__;  // "12.2.0"
  EXPECT_NE(is.compiler.find(compiler.substr(compiler.find_first_of("0123456789"), 3)), std::string::npos);
#endif
}

}  // namespace
}  // namespace gale
