#include <impoint/base/stored_pieces.h>

#include <fstream>

namespace Impoint
{
  StoredPieces::StoredPieces(const std::string         &path,
                             const std::vector<Extent> &extents)
    : path(path)
    , extents(extents)
  {}



  void StoredPieces::for_each(const std::function<void(StateArchive &)> &read)
  {
    for (auto &[begin, size] : extents)
      {
        StateArchive archive(read_bytes(path, {begin, size}));
        read(archive);
        begin += archive.n_read();
        size -= archive.n_read();
      }
  }



  std::string read_bytes(const std::string          &path,
                         const StoredPieces::Extent &extent)
  {
    std::string   bytes(extent.second, ' ');
    std::ifstream file(path, std::ios::binary);
    file.seekg(extent.first);
    if (!file.read(bytes.data(), bytes.size()))
      throw InputError("the checkpoint '" + path + "' cannot be read",
                       "option --resume",
                       "Give all ranks access to the folder.");
    return bytes;
  }
} // namespace Impoint
