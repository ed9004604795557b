#ifndef impoint_base_paths_h
#define impoint_base_paths_h

#include <string>

namespace Impoint
{
  /** As seen from the root, without parts like '..'. Throws InputError where
   * there is no working directory to start from; @p place says who wants it. */
  std::string absolute_path(const std::string &path, const std::string &place);
} // namespace Impoint

#endif
