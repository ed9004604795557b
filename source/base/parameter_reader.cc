#include <impoint/base/exceptions.h>
#include <impoint/base/parameter_reader.h>
#include <impoint/base/words.h>

#include <algorithm>
#include <filesystem>
#include <fstream>

namespace Impoint
{
  namespace
  {
    /** Reads the lines of a file and of those it includes. */
    class SceneReader
    {
    public:
      explicit SceneReader(Assignments &target)
        : target(target)
      {}

      void read(const std::string &file_name, const std::string &wanted_by);

    private:
      struct OpenSection
      {
        std::string  name;
        unsigned int line;
      };

      // Which file is being read and what it has done so far.
      struct Source
      {
        std::string                         name;
        std::filesystem::path               identity;
        std::size_t                         outer_sections;
        unsigned int                        line = 0;
        std::map<std::string, unsigned int> entries_set;
      };

      void read_lines(std::istream &stream);
      void statement(const std::string &text);
      void open_section(const std::string &name);
      void close_section(const std::string &rest);
      void set(const std::string &rest);
      void include(const std::string &name);
      void check_name(const std::string &name) const;

      std::string section_path() const;
      std::string here() const;
      std::string here(const unsigned int line) const;

      Assignments             &target;
      std::vector<Source>      sources;
      std::vector<OpenSection> sections;
    };
  } // namespace



  void SceneReader::read(const std::string &file_name,
                         const std::string &wanted_by)
  {
    std::error_code failed;
    const auto identity = std::filesystem::weakly_canonical(file_name, failed);
    if (failed)
      throw InputError("the file '" + file_name +
                         "' cannot be looked for: " + failed.message(),
                       wanted_by,
                       "Give the name of a file that exists.");
    for (const auto &source : sources)
      if (source.identity == identity)
        throw InputError("'" + file_name +
                           "' includes itself, directly or through other files",
                         wanted_by,
                         "Take this include away.");
    if (std::filesystem::is_directory(file_name, failed))
      throw InputError("'" + file_name + "' is a folder",
                       wanted_by,
                       "Name a .prm file in it.");
    std::ifstream stream(file_name);
    if (!stream)
      throw InputError("the file '" + file_name + "' cannot be read",
                       wanted_by,
                       "Give the name of a file that exists; names in an "
                       "include are relative to the file they stand in.");

    sources.push_back({file_name, identity, sections.size(), 0, {}});
    read_lines(stream);
    if (sections.size() > sources.back().outer_sections)
      throw InputError("section '" + sections.back().name + "' is not closed",
                       here(sections.back().line),
                       "Write 'end' after its last entry.");
    sources.pop_back();
  }



  void SceneReader::read_lines(std::istream &stream)
  {
    std::string  line, joined;
    unsigned int number = 0, first = 1;
    while (std::getline(stream, line))
      {
        ++number;
        if (joined.empty())
          first = number;
        line = Words::trim(line);
        if (!line.empty() && line.back() == '\\')
          {
            joined += line.substr(0, line.size() - 1);
            continue;
          }
        sources.back().line = first;
        statement(
          Words::trim((joined + line).substr(0, (joined + line).find('#'))));
        joined.clear();
      }
    sources.back().line = first;
    statement(Words::trim(joined.substr(0, joined.find('#'))));
  }



  void SceneReader::statement(const std::string &text)
  {
    if (text.empty())
      return;
    const auto  blank   = text.find_first_of(" \t");
    const auto  keyword = text.substr(0, blank);
    std::string rest =
      blank == std::string::npos ? "" : Words::trim(text.substr(blank));

    if (keyword == "subsection" || keyword == "SUBSECTION")
      open_section(rest);
    else if (keyword == "end" || keyword == "END")
      close_section(rest);
    else if (keyword == "set" || keyword == "SET")
      set(rest);
    else if (keyword == "include" || keyword == "INCLUDE")
      include(rest);
    else
      throw InputError(
        "'" + text + "' is not a line of a scene",
        here(),
        Words::suggestion(keyword,
                          {"set", "subsection", "end", "include"},
                          "A line starts with"));
  }



  void SceneReader::open_section(const std::string &name)
  {
    check_name(name);
    sections.push_back({name, sources.back().line});
    target.sections.insert(
      {section_path(), {"", sources.back().name, sources.back().line}});
  }



  void SceneReader::close_section(const std::string &rest)
  {
    if (!rest.empty())
      throw InputError("'" + rest + "' after 'end'",
                       here(),
                       "Put it on a line of its own or behind a '#'.");
    if (sections.size() == sources.back().outer_sections)
      throw InputError("'end' without an open section in this file",
                       here(),
                       "Take it away, or open the section with 'subsection'.");
    sections.pop_back();
  }



  void SceneReader::set(const std::string &rest)
  {
    const auto equal = rest.find('=');
    if (equal == std::string::npos)
      throw InputError("'set " + rest + "' has no '='",
                       here(),
                       "Write 'set entry = value'.");
    const std::string entry = Words::trim(rest.substr(0, equal));
    check_name(entry);
    const std::string section = section_path();
    const std::string path    = section.empty() ? entry : section + "/" + entry;
    Source           &source  = sources.back();

    const auto first = source.entries_set.insert({path, source.line});
    if (!first.second)
      throw InputError("'" + entry +
                         "' is set twice in this file, first in line " +
                         std::to_string(first.first->second),
                       Words::entry(path) + ", " + here(),
                       "Take one of the two lines away.");
    target.record(
      path, {Words::trim(rest.substr(equal + 1)), source.name, source.line});
  }



  void SceneReader::include(const std::string &name)
  {
    if (name.empty())
      throw InputError("'include' without a file",
                       here(),
                       "Write 'include other.prm'.");
    const auto folder =
      std::filesystem::path(sources.back().name).parent_path();
    read((folder / name).string(), here());
  }



  void SceneReader::check_name(const std::string &name) const
  {
    if (name.empty())
      throw InputError("a name is missing",
                       here(),
                       "Write 'subsection name' or 'set entry = value'.");
    if (name.find('/') != std::string::npos)
      throw InputError(
        "'" + name + "' has a '/' in its name",
        here(),
        "Open one subsection in the other; only --set joins them by '/'.");
  }



  std::string SceneReader::section_path() const
  {
    std::vector<std::string> parts;
    for (const auto &section : sections)
      parts.push_back(section.name);
    return Words::join(parts, "/");
  }



  std::string SceneReader::here() const
  {
    return here(sources.back().line);
  }



  std::string SceneReader::here(const unsigned int line) const
  {
    return sources.back().name + ":" + std::to_string(line);
  }



  std::string Assignments::Assignment::place() const
  {
    return file.empty() ? "option --set" : file + ":" + std::to_string(line);
  }



  void Assignments::record(const std::string &path,
                           const Assignment  &assignment)
  {
    if (entries.find(path) == entries.end())
      order.push_back(path);
    entries[path] = assignment;
  }



  void read_scene(const std::string &file_name, Assignments &assignments)
  {
    SceneReader(assignments).read(file_name, "the command line");
  }



  void read_override(const std::string &text, Assignments &assignments)
  {
    const std::string place = "option --set \"" + text + "\"";
    const auto        equal = text.find('=');
    const auto        parts = Words::split(text.substr(0, equal), '/');
    if (equal == std::string::npos || parts.empty() ||
        std::count(parts.begin(), parts.end(), "") > 0)
      throw InputError("this is not an entry and a value",
                       place,
                       "Write --set \"Section/Entry = value\".");
    // parameters.prm, which repeats the run, could not hold such a value
    if (text.find_first_of("#\n") != std::string::npos || text.back() == '\\')
      throw InputError(
        "a value cannot contain '#' or line breaks or end in '\\'",
        place,
        "Write it without.");
    assignments.record(Words::join(parts, "/"),
                       {Words::trim(text.substr(equal + 1)), "", 0});
  }
} // namespace Impoint
