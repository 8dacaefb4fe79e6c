#include <linux/audit.h>
#include <linux/filter.h>
#include <linux/seccomp.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <cerrno>
#include <cstddef>
#include <cstdint>
#include <vector>

#include <gale/io/program/confine.hpp>

namespace gale::reader {

namespace {

#if defined(__x86_64__)
constexpr std::uint32_t this_processor = AUDIT_ARCH_X86_64;
#elif defined(__aarch64__)
constexpr std::uint32_t this_processor = AUDIT_ARCH_AARCH64;
#elif defined(__powerpc64__) && defined(__LITTLE_ENDIAN__)
constexpr std::uint32_t this_processor = AUDIT_ARCH_PPC64LE;
#elif defined(__riscv) && __riscv_xlen == 64
constexpr std::uint32_t this_processor = AUDIT_ARCH_RISCV64;
#else
constexpr std::uint32_t this_processor = 0;
#endif

/// All that reading takes, once the file is open and libraries are loaded.
constexpr std::uint32_t allowed[] = {__NR_read,          __NR_write,        __NR_close,        __NR_lseek,
                                     __NR_mmap,          __NR_munmap,       __NR_mremap,       __NR_mprotect,
                                     __NR_madvise,       __NR_brk,          __NR_futex,        __NR_getrandom,
                                     __NR_clock_gettime, __NR_gettimeofday, __NR_rt_sigreturn, __NR_rt_sigprocmask,
                                     __NR_sigaltstack,   __NR_exit,         __NR_exit_group};

/// Landlock's structure in Linux 6.12; older kernels know the beginning of it, and want the rest to be 0.
struct LandlockRules {
  std::uint64_t files, network, scopes;
};

bool give_up_privileges() { return prctl(PR_SET_NO_NEW_PRIVS, 1, 0, 0, 0) == 0; }

}  // namespace

bool confine_by_landlock() {
  // The numbers are those of every processor; headers may be older than the kernel.
  constexpr long create = 444, restrict_self = 446;
  constexpr int ask_version = 1;
  const long version = syscall(create, nullptr, 0, ask_version);
  if (version < 1 || !give_up_privileges()) return false;
  const int rights = version == 1 ? 13 : version == 2 ? 14 : version < 5 ? 15 : 16;
  LandlockRules rules{(std::uint64_t(1) << rights) - 1, version < 4 ? 0u : 3u, version < 6 ? 0u : 3u};
  const std::size_t size = version < 4 ? 8 : version < 6 ? 16 : sizeof rules;
  const long set = syscall(create, &rules, size, 0);
  if (set < 0) return false;
  const bool is_confined = syscall(restrict_self, set, 0) == 0;
  close(static_cast<int>(set));
  return is_confined;
}

bool confine_by_filter() {
  if (this_processor == 0 || !give_up_privileges()) return false;
  const auto load = [](std::size_t offset) {
    return sock_filter BPF_STMT(BPF_LD | BPF_W | BPF_ABS, static_cast<std::uint32_t>(offset));
  };
  const auto answer = [](std::uint32_t what) { return sock_filter BPF_STMT(BPF_RET | BPF_K, what); };
  const auto skip_unless = [](std::uint32_t value) {
    return sock_filter BPF_JUMP(BPF_JMP | BPF_JEQ | BPF_K, value, 0, 1);
  };
  std::vector<sock_filter> filter{load(offsetof(seccomp_data, arch)),
                                  sock_filter BPF_JUMP(BPF_JMP | BPF_JEQ | BPF_K, this_processor, 1, 0),
                                  answer(SECCOMP_RET_ERRNO | EPERM), load(offsetof(seccomp_data, nr))};
  for (const std::uint32_t call : allowed) {
    filter.push_back(skip_unless(call));
    filter.push_back(answer(SECCOMP_RET_ALLOW));
  }
  filter.push_back(answer(SECCOMP_RET_ERRNO | EPERM));
  const sock_fprog program{static_cast<unsigned short>(filter.size()), filter.data()};
  return prctl(PR_SET_SECCOMP, SECCOMP_MODE_FILTER, &program, 0, 0) == 0;
}

bool confine_by_limits() {
  const rlimit none{0, 0};
  return setrlimit(RLIMIT_NOFILE, &none) == 0;
}

void confine() {
  confine_by_limits();
  confine_by_landlock();
  confine_by_filter();
}

}  // namespace gale::reader
