#include <poll.h>
#include <unistd.h>

#include <atomic>
#include <cstdlib>
#include <cstring>
#include <memory>
#include <new>
#include <utility>

#include <gale/io/atomic_file.hpp>

namespace gale::io {
namespace {

constexpr int ending_signals[] = {SIGHUP,  SIGINT, SIGQUIT, SIGPIPE, SIGALRM, SIGTERM,
                                  SIGXCPU, SIGILL, SIGABRT, SIGBUS,  SIGFPE,  SIGSEGV};

/// A name that is to be removed. Places are reused and never freed, so that a handler may walk over them at any time;
/// it calls nothing but what POSIX lets it call.
struct Place {
  std::atomic<char*> name{nullptr};
  Place* next = nullptr;
};

std::atomic<Place*> first{nullptr};
std::atomic<int> uninterrupted{0};  ///< how many live
std::atomic<bool> ending{false};

/// Puts `name` where a handler finds it.
Place* remember(char* name) {
  for (Place* place = first; place != nullptr; place = place->next) {
    char* none = nullptr;
    if (place->name.compare_exchange_strong(none, name)) return place;
  }
  auto* const place = new Place;
  place->name = name;
  place->next = first;
  while (!first.compare_exchange_weak(place->next, place)) {
  }
  return place;
}

/// Whoever takes a name out of its place owns it; a handler never frees one.
void remove_all() noexcept {
  for (Place* place = first; place != nullptr; place = place->next) {
    if (const char* const name = place->name.exchange(nullptr)) unlink(name);
  }
}

sigset_t all_ending_signals() {
  sigset_t all;
  sigemptyset(&all);
  for (const int signal : ending_signals) sigaddset(&all, signal);
  return all;
}

void end_by(int signal) {
  if (ending.exchange(true)) return;  // another thread is at it
  for (int waited = 0; uninterrupted != 0 && waited < 2000; ++waited) poll(nullptr, 0, 1);
  remove_all();
  struct sigaction standard {};
  standard.sa_handler = SIG_DFL;
  sigaction(signal, &standard, nullptr);
  sigset_t one;
  sigemptyset(&one);
  sigaddset(&one, signal);
  pthread_sigmask(SIG_UNBLOCK, &one, nullptr);
  raise(signal);
}

}  // namespace

void remove_temporary_files() { remove_all(); }

void remove_temporary_files_at_end() {
  std::atexit(remove_all);
  for (const int signal : ending_signals) {
    struct sigaction there {};
    if (sigaction(signal, nullptr, &there) != 0 || (there.sa_flags & SA_SIGINFO) != 0 || there.sa_handler != SIG_DFL)
      continue;
    struct sigaction ours {};
    ours.sa_handler = end_by;
    ours.sa_mask = all_ending_signals();
    sigaction(signal, &ours, nullptr);
  }
}

namespace detail {

Uninterrupted::Uninterrupted() {
  const sigset_t all = all_ending_signals();
  pthread_sigmask(SIG_BLOCK, &all, &before_);
  ++uninterrupted;
  if (!ending) return;
  --uninterrupted;
  while (true) pause();  // the process ends now, and nothing new is to begin
}

Uninterrupted::~Uninterrupted() {
  --uninterrupted;
  pthread_sigmask(SIG_SETMASK, &before_, nullptr);
}

TemporaryName::TemporaryName(const std::string& path) : path_(path) {
  std::unique_ptr<char, decltype(&std::free)> copy(strdup(path.c_str()), &std::free);
  if (copy == nullptr) throw std::bad_alloc();
  place_ = remember(copy.get());
  copy_ = copy.release();
}

TemporaryName::~TemporaryName() {
  if (copy_ == nullptr) return;
  unlink(path_.c_str());
  forget();
}

TemporaryName::TemporaryName(TemporaryName&& other) noexcept { *this = std::move(other); }

TemporaryName& TemporaryName::operator=(TemporaryName&& other) noexcept {
  std::swap(path_, other.path_);
  std::swap(copy_, other.copy_);
  std::swap(place_, other.place_);
  return *this;
}

void TemporaryName::forget() {
  if (copy_ == nullptr) return;
  char* ours = copy_;
  if (static_cast<Place*>(place_)->name.compare_exchange_strong(ours, nullptr)) std::free(copy_);
  copy_ = nullptr;
}

}  // namespace detail
}  // namespace gale::io
