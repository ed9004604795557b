#ifndef impoint_base_declared_paths_h
#define impoint_base_declared_paths_h

#include <set>
#include <string>
#include <vector>

namespace Impoint
{
  /** The entries that a scene can have, and what to say about others. */
  class DeclaredPaths
  {
  public:
    /** @p entries: all paths "A/B/entry". */
    explicit DeclaredPaths(const std::vector<std::string> &entries);

    /** Throws InputError, with @p place, if there is no such section. */
    void require_section(const std::string &path,
                         const std::string &place) const;

    /** Whether @p path is or lies in the section of a thing that could exist
     * but is not in its list of names: "A/x" where there is an entry "A/Names".
     */
    bool is_unnamed(const std::string &path) const;

    /** Throws InputError, with @p place, if there is no such entry. */
    void require_entry(const std::string &path, const std::string &place) const;

  private:
    bool        is_entry(const std::string &path) const;
    std::string advice_on_section(const std::string &path) const;
    std::string advice_on_entry(const std::string &path) const;

    /** The entry of the same name in the most similar section, or nothing. */
    std::string namesake(const std::string &path) const;

    std::vector<std::string> entries;
    std::set<std::string>    sections;
  };
} // namespace Impoint

#endif
