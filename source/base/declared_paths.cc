#include <impoint/base/declared_paths.h>
#include <impoint/base/exceptions.h>
#include <impoint/base/words.h>

#include <algorithm>

namespace Impoint
{
  namespace
  {
    // Names of those @p paths that stand directly in @p section.
    template <typename Container>
    std::vector<std::string> names_in(const std::string &section,
                                      const Container   &paths)
    {
      std::vector<std::string> names;
      for (const auto &path : paths)
        if (Words::parent(path) == section)
          names.push_back(Words::last_part(path));
      return names;
    }



    std::string with_slashes(std::string path)
    {
      std::replace(path.begin(), path.end(), '.', '/');
      return path;
    }



    std::size_t common_letters(const std::string &left,
                               const std::string &right)
    {
      const auto shorter = std::min(left.size(), right.size());
      return std::mismatch(left.begin(), left.begin() + shorter, right.begin())
               .first -
             left.begin();
    }
  } // namespace



  DeclaredPaths::DeclaredPaths(const std::vector<std::string> &entries)
    : entries(entries)
  {
    for (const auto &path : entries)
      for (auto section = Words::parent(path); !section.empty();
           section      = Words::parent(section))
        sections.insert(section);
  }



  void DeclaredPaths::require_section(const std::string &path,
                                      const std::string &place) const
  {
    if (path.empty() || sections.count(path) > 0)
      return;
    const std::string parent = Words::parent(path);
    // what stands in an unknown section is unknown as well: name the outermost
    require_section(parent, place);
    throw InputError("there is no section '" + path + "'",
                     place,
                     advice_on_section(path));
  }



  bool DeclaredPaths::is_unnamed(const std::string &path) const
  {
    std::string outermost;
    for (std::string section = path; !section.empty();
         section             = Words::parent(section))
      if (sections.count(section) == 0)
        outermost = section;
    const std::string list = Words::parent(outermost);
    return !list.empty() && is_entry(list + "/Names");
  }



  bool DeclaredPaths::is_entry(const std::string &path) const
  {
    return std::find(entries.begin(), entries.end(), path) != entries.end();
  }



  void DeclaredPaths::require_entry(const std::string &path,
                                    const std::string &place) const
  {
    require_section(Words::parent(path), place);
    if (!is_entry(path))
      throw InputError("there is no entry '" + Words::last_part(path) + "'",
                       place,
                       advice_on_entry(path));
  }



  std::string DeclaredPaths::advice_on_section(const std::string &path) const
  {
    const std::string name     = Words::last_part(path),
                      parent   = Words::parent(path);
    const auto        siblings = names_in(parent, sections);
    const std::string list     = parent.empty() ? "Names" : parent + "/Names";

    if (sections.count(with_slashes(path)) > 0)
      return "Write '" + with_slashes(path) + "': '/' stands between sections.";
    if (is_entry(list) && Words::nearest(name, siblings).empty())
      return "Add '" + name + "' to " + Words::entry(list) +
             " (names are separated by commas), or take the section away.";
    if (siblings.empty())
      return "Take it away: there are no sections here.";
    return Words::suggestion(name, siblings, "The sections here are");
  }



  std::string DeclaredPaths::advice_on_entry(const std::string &path) const
  {
    const std::string name  = Words::last_part(path);
    const auto        here  = names_in(Words::parent(path), entries);
    const std::string near  = Words::nearest(name, here);
    const std::string other = namesake(path);
    if (is_entry(with_slashes(path)))
      return "Write '" + with_slashes(path) +
             "': '/' stands between section and entry.";
    const std::string question =
      near.empty() ? "" : "Did you mean '" + near + "'?";

    if (!other.empty())
      return question + (near.empty() ? "" : " ") + "There is an " +
             Words::entry(other) + ".";
    if (here.empty())
      return "Take it away: there are no entries here.";
    return Words::suggestion(name, here, "The entries here are");
  }



  std::string DeclaredPaths::namesake(const std::string &path) const
  {
    std::string best;
    for (const auto &entry : entries)
      if (Words::last_part(entry) == Words::last_part(path) &&
          (best.empty() ||
           common_letters(path, entry) > common_letters(path, best)))
        best = entry;
    return best;
  }
} // namespace Impoint
