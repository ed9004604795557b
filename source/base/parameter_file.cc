#include <impoint/base/declared_paths.h>
#include <impoint/base/parameter_file.h>
#include <impoint/base/paths.h>

#include <boost/property_tree/ptree.hpp>
#include <boost/property_tree/xml_parser.hpp>

#include <algorithm>
#include <cctype>
#include <filesystem>
#include <functional>
#include <sstream>

namespace Impoint
{
  namespace
  {
    // ParameterHandler writes all but letters and digits of a name as _hh
    std::string demangled(const std::string &name)
    {
      std::string text;
      for (std::string::size_type i = 0; i < name.size(); ++i)
        if (name[i] == '_')
          {
            text +=
              static_cast<char>(std::stoi(name.substr(i + 1, 2), nullptr, 16));
            i += 2;
          }
        else
          text += name[i];
      return text;
    }



    std::string on_one_line(const std::string &text)
    {
      std::istringstream       stream(text);
      std::vector<std::string> words;
      for (std::string word; stream >> word;)
        words.push_back(word);
      return Words::join(words, " ");
    }
  } // namespace



  ParameterFile::ParameterFile(const std::string              &file_name,
                               const std::vector<std::string> &overrides)
    : scene_file(file_name)
  {
    if (!file_name.empty())
      read_scene(file_name, assignments);
    for (const auto &text : overrides)
      read_override(text, assignments);
  }



  ParameterFile::ParameterFile()
    : ParameterFile("", {})
  {}



  std::string ParameterFile::raw(const std::string &path,
                                 const std::string &fallback) const
  {
    const auto found = assignments.entries.find(path);
    return found == assignments.entries.end() ? fallback : found->second.value;
  }



  std::string ParameterFile::value(const std::string &path) const
  {
    return is_assigned(path) ? raw(path, "") :
                               prm.get(Words::split(Words::parent(path), '/'),
                                       Words::last_part(path));
  }



  std::vector<std::string> ParameterFile::names(const std::string &path) const
  {
    const auto names = Words::split(raw(path, ""), ',');
    for (auto name = names.begin(); name != names.end(); ++name)
      {
        if (name->empty())
          throw error(path,
                      "'" + raw(path, "") + "' has an empty name",
                      "Write names separated by single commas.");
        const bool usable = std::all_of(name->begin(),
                                        name->end(),
                                        [](const unsigned char letter) {
                                          return std::isalnum(letter) ||
                                                 letter == '_' ||
                                                 letter == '-' || letter == ' ';
                                        });
        if (!usable || *name == Words::last_part(path))
          throw error(path,
                      "'" + *name + "' cannot be a name",
                      "Use letters, digits, '-', '_' and blanks; '" +
                        Words::last_part(path) + "' itself is taken.");
        if (std::find(names.begin(), name, *name) != name)
          throw error(path,
                      "the name '" + *name + "' occurs twice",
                      "Give each its own name.");
      }
    return names;
  }



  EntryHandler &ParameterFile::handler()
  {
    return prm;
  }



  void ParameterFile::apply()
  {
    const auto               declared = entries();
    std::vector<std::string> paths;
    for (const auto &entry : declared)
      paths.push_back(entry.path);
    const DeclaredPaths known(paths);

    // A scene may leave out what a file describes that it includes.
    const auto is_included = [&](const Assignments::Assignment &assignment) {
      return !assignment.file.empty() && assignment.file != scene_file;
    };
    for (const auto &[path, assignment] : assignments.sections)
      if (!is_included(assignment) || !known.is_unnamed(path))
        known.require_section(path, assignment.place());
    for (const auto &path : assignments.order)
      if (!is_included(assignments.entries.at(path)) ||
          !known.is_unnamed(Words::parent(path)))
        known.require_entry(path, place(path));
    for (const auto &entry : declared)
      {
        defaults[entry.path] = entry.default_value;
        if (is_assigned(entry.path))
          set(entry);
      }
  }



  void ParameterFile::set(const Entry &entry)
  {
    const std::string text     = raw(entry.path, "");
    const auto        sections = Words::split(Words::parent(entry.path), '/');
    for (const auto &section : sections)
      prm.enter_subsection(section);
    try
      {
        prm.set(Words::last_part(entry.path), text);
      }
    catch (const ExceptionBase &)
      {
        const auto near   = Words::nearest(text, Words::choices(entry.pattern));
        const auto number = Words::with_point(text, entry.pattern);
        if (!number.empty())
          throw error(entry.path,
                      "'" + text + "' has a comma",
                      "Write a decimal point: " + number + ".");
        throw error(entry.path,
                    text.empty() ? "the value is empty" :
                                   "'" + text + "' is not allowed",
                    "Set " + Words::allowed(entry.pattern) + "." +
                      (near.empty() ? "" : " Did you mean '" + near + "'?"));
      }
    for (unsigned int i = 0; i < sections.size(); ++i)
      prm.leave_subsection();
  }



  bool ParameterFile::is_assigned(const std::string &path) const
  {
    return assignments.entries.find(path) != assignments.entries.end();
  }



  bool ParameterFile::is_set(const std::string &path) const
  {
    const auto default_value = defaults.find(path);
    return is_assigned(path) && (default_value == defaults.end() ||
                                 raw(path, "") != default_value->second);
  }



  InputError ParameterFile::error(const std::string &path,
                                  const std::string &wrong,
                                  const std::string &advice) const
  {
    return InputError(wrong, place(path), advice);
  }



  std::string ParameterFile::place(const std::string &path) const
  {
    const auto found = assignments.entries.find(path);
    if (found != assignments.entries.end())
      return Words::entry(path) + ", " + found->second.place();
    try
      {
        return Words::entry(path) + " (not set, default '" + value(path) + "')";
      }
    catch (const ParameterHandler::ExcEntryUndeclared &)
      {
        return Words::entry(path) + " (not set)";
      }
  }



  std::string ParameterFile::absolute(const std::string &path) const
  {
    const std::string name = value(path);
    if (name.empty())
      return "";
    const auto        found = assignments.entries.find(path);
    const std::string from =
      found == assignments.entries.end() ? scene_file : found->second.file;
    const auto folder = std::filesystem::path(from).parent_path();
    return absolute_path((folder / name).string(), place(path));
  }



  void ParameterFile::declare_as_path(const std::string &path)
  {
    path_entries.push_back(path);
  }



  void ParameterFile::print_template(std::ostream &out) const
  {
    print(out, true);
  }



  void ParameterFile::print_used(std::ostream &out) const
  {
    print(out, false);
  }



  const std::string &ParameterFile::file_name() const
  {
    return scene_file;
  }



  void ParameterFile::print(std::ostream &out, const bool as_template) const
  {
    std::vector<std::string> open;
    const auto indent = [&]() { return std::string(2 * open.size(), ' '); };
    const auto close  = [&](const std::size_t depth) {
      while (open.size() > depth)
        {
          open.pop_back();
          out << indent() << "end\n";
        }
    };

    for (const auto &entry : entries())
      {
        const auto sections = Words::split(Words::parent(entry.path), '/');
        const auto shared   = std::mismatch(open.begin(),
                                          open.end(),
                                          sections.begin(),
                                          sections.end());
        close(shared.first - open.begin());
        for (auto section = shared.second; section != sections.end(); ++section)
          {
            out << (as_template ? "\n" : "") << indent() << "subsection "
                << *section << '\n';
            open.push_back(*section);
          }

        if (as_template)
          out << indent() << "# " << on_one_line(entry.documentation) << " ["
              << Words::allowed(entry.pattern) << "; default '"
              << entry.default_value << "']\n";
        out << indent() << "set " << Words::last_part(entry.path) << " = "
            << text_of(entry.path, as_template) << '\n';
      }
    close(0);
  }



  std::string ParameterFile::text_of(const std::string &path,
                                     const bool         as_template) const
  {
    const bool is_path =
      std::find(path_entries.begin(), path_entries.end(), path) !=
      path_entries.end();
    // a template may be used from another folder, where defaults mean
    // another place but what the user wrote must not
    if (!is_path || (as_template && !is_assigned(path)))
      return value(path);
    const std::string text = absolute(path);
    if (text.find_first_of("#\n") != std::string::npos ||
        Words::trim(text) != text || (!text.empty() && text.back() == '\\'))
      throw error(path,
                  "no scene file can hold the path '" + text + "'",
                  "Use folders and files without '#', and without blanks, "
                  "line breaks or '\\' at the end.");
    return text;
  }



  std::vector<std::pair<std::string, std::string>> ParameterFile::used() const
  {
    std::vector<std::pair<std::string, std::string>> values;
    for (const auto &entry : entries())
      values.emplace_back(entry.path, text_of(entry.path, false));
    return values;
  }



  std::vector<ParameterFile::Entry> ParameterFile::entries() const
  {
    // ParameterHandler keeps its entries to itself but prints them all
    std::stringstream xml;
    prm.print_parameters(xml,
                         ParameterHandler::XML |
                           ParameterHandler::KeepDeclarationOrder);
    boost::property_tree::ptree tree;
    boost::property_tree::read_xml(xml, tree);

    std::vector<Entry> found;
    const std::function<void(const boost::property_tree::ptree &,
                             const std::string &)>
      collect = [&](const auto &node, const std::string &path) {
        if (node.count("value") > 0)
          found.push_back({path,
                           node.get("default_value", ""),
                           node.get("documentation", ""),
                           node.get("pattern_description", "")});
        else
          for (const auto &child : node)
            collect(child.second,
                    (path.empty() ? "" : path + "/") + demangled(child.first));
      };
    collect(tree.get_child("ParameterHandler"), "");
    return found;
  }
} // namespace Impoint
