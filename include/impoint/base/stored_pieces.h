#ifndef impoint_base_stored_pieces_h
#define impoint_base_stored_pieces_h

#include <impoint/base/state_archive.h>

#include <cstdint>
#include <functional>
#include <string>
#include <utility>
#include <vector>

namespace Impoint
{
  /**
   * What the ranks of a run stored in a file, a piece each: a piece at a time
   * is in memory.
   */
  class StoredPieces
  {
  public:
    /** First byte and number of bytes of a piece. */
    using Extent = std::pair<std::uint64_t, std::uint64_t>;

    StoredPieces() = default;
    StoredPieces(const std::string &path, const std::vector<Extent> &extents);

    /** Hands the pieces to @p read one after the other, each from where the
     * last call has stopped reading. Throws InputError. */
    void for_each(const std::function<void(StateArchive &)> &read);

  private:
    std::string         path;
    std::vector<Extent> extents; // of what has not been read
  };

  /** Reads part of a file. Throws InputError. */
  std::string read_bytes(const std::string          &path,
                         const StoredPieces::Extent &extent);
} // namespace Impoint

#endif
