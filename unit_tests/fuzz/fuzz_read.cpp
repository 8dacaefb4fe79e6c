// Reads mutated files, in child processes, so that a crash names its input and all goes on.
//   fuzz_read CORPUS [--count N] [--from I] [--seconds S] [--finds FOLDER]    mutations I to I + N - 1 of the corpus
//   fuzz_read --files FOLDER [--finds FOLDER]                                 the files of a folder, with all options
// Exit code 0 if nothing was found, 1 if something was.
#include <fcntl.h>
#include <unistd.h>

#include <chrono>
#include <cstdio>
#include <cstring>
#include <iostream>
#include <map>

#include <Kokkos_Core.hpp>

#include <gale/base/kokkos.hpp>
#include <gale/base/threads.hpp>

#include "fuzz/batches.hpp"
#include "fuzz/check_read.hpp"
#include "fuzz/mutate.hpp"

namespace {

using namespace gale::fuzz;
namespace fs = std::filesystem;

struct Options {
  fs::path corpus, files, finds = "finds";
  std::uint64_t count = 5000, from = 0;
  double seconds = 1e9;
};

bool parse(int argc, char** argv, Options& options) {
  for (int i = 1; i < argc; ++i) {
    const std::string name = argv[i];
    const char* const value = i + 1 < argc ? argv[i + 1] : nullptr;
    if (name.rfind("--", 0) != 0) {
      options.corpus = name;
      continue;
    }
    if (value == nullptr) return false;
    ++i;
    if (name == "--count") {
      options.count = std::strtoull(value, nullptr, 10);
    } else if (name == "--from") {
      options.from = std::strtoull(value, nullptr, 10);
    } else if (name == "--seconds") {
      options.seconds = std::atof(value);
    } else if (name == "--finds") {
      options.finds = value;
    } else if (name == "--files") {
      options.files = value;
    } else {
      return false;
    }
  }
  return !options.corpus.empty() || !options.files.empty();
}

/// Cases by number: mutations of a corpus, or files as they are, each with four options.
class Cases {
 public:
  explicit Cases(const Options& options) : mutates_(options.files.empty()) {
    for (const fs::path& file : files_in(mutates_ ? options.corpus : options.files)) {
      seeds_.push_back(load(file));
      names_.push_back(file.filename().string());
    }
  }

  std::uint64_t files() const { return seeds_.size(); }

  Mutation operator()(std::uint64_t number) const {
    if (mutates_) return mutated(seeds_, names_, number);
    const std::size_t which = static_cast<std::size_t>(number / 4);
    Mutation same{seeds_[which], names_[which]};
    same.result.options.simplices_alone = number % 2 == 1;
    if (number % 4 >= 2) same.result.options.above = 2;
    return same;
  }

 private:
  bool mutates_;
  std::vector<Case> seeds_;
  std::vector<std::string> names_;
};

/// Keeps what was found, and says so; of one kind not more than some.
class Finds {
 public:
  Finds(const fs::path& folder, const Cases& cases) : folder_(folder), cases_(cases) {}

  void add(std::uint64_t number, const std::string& complaint, const std::string& output) {
    const Mutation mutation = cases_(number);
    std::string kind = mutation.result.extension + ' ';
    for (const char c : complaint.substr(0, 60)) {
      if (c < '0' || c > '9') kind += c;
    }
    ++count_;
    if (++kinds_[kind] > 5) return;
    fs::create_directories(folder_);
    const fs::path file = save(mutation.result, folder_ / ("find_" + std::to_string(number)));
    put(file.string() + ".txt", complaint + "\n" + mutation.story + "\n" + output);
    std::cout << file.string() << ": " << complaint << "\n    " << mutation.story << std::endl;
  }

  int tell() const {
    for (const auto& [kind, count] : kinds_) std::cout << count << " of: " << kind << "\n";
    return count_ == 0 ? 0 : 1;
  }

  std::uint64_t count() const { return count_; }

 private:
  const fs::path folder_;
  const Cases& cases_;
  std::map<std::string, int> kinds_;
  std::uint64_t count_ = 0;
};

}  // namespace

int main(int argc, char** argv) {
  Options options;
  if (!parse(argc, argv, options)) {
    std::cerr << "usage: " << argv[0]
              << " CORPUS [--count N] [--from I] [--seconds S] [--finds FOLDER], or --files FOLDER\n";
    return 2;
  }
  const Cases cases(options);
  if (!options.files.empty()) options.count = 4 * cases.files();
  const bool has_memory_folder = fs::is_directory("/dev/shm");
  const fs::path folder = (has_memory_folder ? fs::path("/dev/shm") : fs::temp_directory_path()) /
                          ("gale_fuzz_" + std::to_string(getpid()));
  fs::create_directories(folder);
  Finds finds(options.finds, cases);
  Batches batches(folder);
  batches.begin = [] {
    gale::set_host_threads(1);
    Kokkos::initialize(gale::initialization_arguments(1));
  };
  batches.check = [&](std::uint64_t number) { return complaint_about(cases(number).result, folder); };
  batches.succeeded = was_read;
  batches.found = [&](std::uint64_t number, const std::string& what, const std::string& output) {
    finds.add(number, what, output);
  };
  const auto tried = batches.run(options.from, options.count, options.seconds);
  fs::remove_all(folder);
  const int result = finds.tell();
  std::cout << tried.count << " files tried from number " << options.from << ", " << tried.succeeded
            << " of them read, " << finds.count() << " finds; " << static_cast<int>(tried.seconds) << " s\n";
  return result;
}
