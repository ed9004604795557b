#include <impoint/base/exceptions.h>
#include <impoint/base/paths.h>

#include <filesystem>

namespace Impoint
{
  std::string absolute_path(const std::string &path, const std::string &place)
  {
    std::error_code failed;
    const auto      found = std::filesystem::absolute(path, failed);
    if (failed)
      throw InputError("'" + path +
                         "' cannot be found from the working directory, "
                         "which says: " +
                         failed.message(),
                       place,
                       "Change to a folder that exists, or give paths that "
                       "begin with '/'.");
    return found.lexically_normal().string();
  }
} // namespace Impoint
