#include <mutex>

#include <gale/base/error.hpp>
#include <gale/base/momentary.hpp>

namespace gale::detail {

namespace {

/// Pieces of the workers' memory that are kept, until Kokkos ends.
class KeptPieces {
 public:
  static KeptPieces& instance() {
    static KeptPieces pieces;
    return pieces;
  }

  std::shared_ptr<void> take(std::size_t bytes) {
    if (bytes == 0 || bytes > piece_bytes) return nullptr;
    const TrackedViews tracked;
    const Piece piece = take_one();
    if (piece.data() == nullptr) return nullptr;
    return {piece.data(), [this, piece](void*) { give_back(piece); }};
  }

 private:
  using Piece = Array<char, WorkerMemory>;
  static constexpr std::size_t piece_bytes = std::size_t(2) << 20;
  static constexpr int most_pieces = 4;

  /// One that is free or new; none if there is neither.
  Piece take_one() {
    const std::lock_guard<std::mutex> lock(mutex_);
    if (free_.empty() && made_ < most_pieces) make_one();
    if (free_.empty()) return {};
    const Piece piece = free_.back();
    free_.pop_back();
    return piece;
  }

  void make_one() {
    free_.reserve(most_pieces);
    try {
      free_.push_back(allocate<Piece>("GALE::kept_memory", piece_bytes));
    } catch (const OutOfMemory&) {
      return;
    }
    if (made_++ > 0) return;
    call_at_end([this] {
      free_.clear();
      made_ = 0;
    });
  }

  void give_back(const Piece& piece) {
    const std::lock_guard<std::mutex> lock(mutex_);
    const TrackedViews tracked;
    free_.push_back(piece);
  }

  std::mutex mutex_;
  std::vector<Piece> free_;
  int made_ = 0;
};

}  // namespace

std::shared_ptr<void> take_kept_bytes(std::size_t bytes) { return KeptPieces::instance().take(bytes); }

}  // namespace gale::detail
