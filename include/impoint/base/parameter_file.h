#ifndef impoint_base_parameter_file_h
#define impoint_base_parameter_file_h

#include <impoint/base/exceptions.h>
#include <impoint/base/parameter_reader.h>
#include <impoint/base/words.h>

#include <deal.II/base/parameter_handler.h>

#include <iosfwd>
#include <map>
#include <memory>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

namespace Impoint
{
  using namespace dealii;

  /**
   * deal.II's handler with two traps closed: its add_parameter() rounds a
   * variable's default to six digits and lets negative numbers into unsigned
   * variables. Hold it by auto & or by this name, not by that of its base.
   */
  class EntryHandler : public ParameterHandler
  {
  public:
    template <typename T>
    static std::unique_ptr<Patterns::PatternBase> default_pattern();

    template <typename T>
    void
    add_parameter(const std::string           &entry,
                  T                           &parameter,
                  const std::string           &documentation,
                  const Patterns::PatternBase &pattern = *default_pattern<T>());

    /** An entry that is one of some names, each of a value of @p choice, whose
     * present value is the default. */
    template <typename Value>
    void add_choice(const std::string &entry,
                    Value             &choice,
                    const std::string &documentation,
                    const std::vector<std::pair<std::string, Value>> &names);
  };

  /**
   * A scene file as the user wrote it: remembers for every entry the file and
   * line (or override) that set it, so that every message can say where.
   *
   * Order of use: read (constructor), ask for what decides which entries
   * exist (raw()), declare entries with handler(), apply(), check.
   * Entries are addressed by path, sections and entry joined by '/':
   * "Bodies/beam/Material/Model"; no name can contain a '/'.
   */
  class ParameterFile
  {
  public:
    /**
     * Reads @p file_name with its includes, then @p overrides of the form
     * "Section/Entry = value". An empty @p file_name is a scene of defaults
     * (for --print-parameters without a file). Throws InputError on what
     * cannot be read.
     */
    ParameterFile(const std::string              &file_name,
                  const std::vector<std::string> &overrides);

    /** A scene of defaults only. */
    ParameterFile();

    /** The text set for @p path, or @p fallback. */
    std::string raw(const std::string &path, const std::string &fallback) const;

    /** The text set for @p path, or the default it was declared with. */
    std::string value(const std::string &path) const;

    /** The comma-separated names set for @p path, each checked to be usable as
     * a section's name and to occur once. */
    std::vector<std::string> names(const std::string &path) const;

    /** Where modules declare their entries, standing at the top section. */
    EntryHandler &handler();

    /**
     * Gives every recorded entry to the handler, which stores it in the
     * variables registered by add_parameter(). Throws InputError for an unknown
     * section or entry (with a near name) or a value outside its range.
     * Sections of included files are passed over where they describe a thing
     * that is not in its list of names: a scene leaves out what it wants.
     */
    void apply();

    /** Whether the user set @p path to something else than its default: a
     * scene that writes all defaults down is the same scene. */
    bool is_set(const std::string &path) const;

    /** The error to throw for the entry @p path. */
    InputError error(const std::string &path,
                     const std::string &wrong,
                     const std::string &advice) const;

    /** "entry 'E' in section 'A/B', scene.prm:17" (or "not set, default
     * '...'"). */
    std::string place(const std::string &path) const;

    /** The value of @p path as an absolute path: relative ones are taken from
     * the folder of the file that set them, defaults from the scene's folder,
     * overrides from the working directory. Empty stays empty. */
    std::string absolute(const std::string &path) const;

    /** Marks @p path as naming a file, printed absolute by print_used(). */
    void declare_as_path(const std::string &path);

    /** Every entry with value, default, range and documentation. */
    void print_template(std::ostream &out) const;

    /** The values in use, paths absolute: running it repeats the run. */
    void print_used(std::ostream &out) const;

    /** The same as paths of entries and values. */
    std::vector<std::pair<std::string, std::string>> used() const;

    const std::string &file_name() const;

  private:
    struct Entry
    {
      std::string path, default_value, documentation, pattern;
    };

    /** What has been declared, in this order. */
    std::vector<Entry> entries() const;

    void        set(const Entry &entry);
    bool        is_assigned(const std::string &path) const;
    void        print(std::ostream &out, const bool as_template) const;
    std::string text_of(const std::string &path, const bool as_template) const;

    std::string                        scene_file;
    EntryHandler                       prm;
    Assignments                        assignments;
    std::vector<std::string>           path_entries;
    std::map<std::string, std::string> defaults; // known after apply()
  };



  template <typename T>
  std::unique_ptr<Patterns::PatternBase> EntryHandler::default_pattern()
  {
    // deal.II's own pattern casts the largest unsigned number to the bound -1,
    // which it takes as no bounds at all
    if constexpr (std::is_unsigned_v<T> && !std::is_same_v<T, bool>)
      return std::make_unique<Patterns::Integer>(0);
    else
      return Patterns::Tools::Convert<T>::to_pattern();
  }



  template <typename T>
  void EntryHandler::add_parameter(const std::string           &entry,
                                   T                           &parameter,
                                   const std::string           &documentation,
                                   const Patterns::PatternBase &pattern)
  {
    const T exact_default = parameter;
    ParameterHandler::add_parameter(entry, parameter, documentation, pattern);
    if constexpr (std::is_same_v<T, double>)
      {
        // declaring again replaces the rounded text
        declare_entry(entry,
                      Words::exact(exact_default),
                      pattern,
                      documentation);
        parameter = exact_default;
      }
    Assert(parameter == exact_default,
           ExcMessage("The default of '" + entry +
                      "' needs more digits than deal.II keeps."));
  }



  template <typename Value>
  void EntryHandler::add_choice(
    const std::string                                &entry,
    Value                                            &choice,
    const std::string                                &documentation,
    const std::vector<std::pair<std::string, Value>> &names)
  {
    std::string              first;
    std::vector<std::string> all;
    for (const auto &[name, value] : names)
      {
        all.push_back(name);
        if (value == choice)
          first = name;
      }
    declare_entry(entry,
                  first,
                  Patterns::Selection(Words::join(all, "|")),
                  documentation);
    add_action(entry, [&choice, names](const std::string &text) {
      for (const auto &[name, value] : names)
        if (name == text)
          choice = value;
    });
  }
} // namespace Impoint

#endif
