#ifndef impoint_base_parameter_reader_h
#define impoint_base_parameter_reader_h

#include <map>
#include <string>
#include <vector>

namespace Impoint
{
  /** What a scene sets, and where: entries and sections by path ("A/B/entry").
   */
  struct Assignments
  {
    struct Assignment
    {
      std::string  value;
      std::string  file;     // empty: an override
      unsigned int line = 0; // 0: an override

      /** "scene.prm:17" or "option --set". */
      std::string place() const;
    };

    /** Notes an entry; a later one wins. */
    void record(const std::string &path, const Assignment &assignment);

    std::map<std::string, Assignment> entries;
    std::map<std::string, Assignment> sections; // where first opened
    std::vector<std::string>          order;    // entries as first set
  };

  /**
   * Reads a file in the .prm syntax of deal.II and the files it includes, which
   * are looked for from the folder of the file that names them. Throws
   * InputError with file and line for what is not of this syntax, files that
   * cannot be read or include themselves, and entries set twice in one file.
   */
  void read_scene(const std::string &file_name, Assignments &assignments);

  /** Reads "Section/Entry = value", as written on the command line. Throws
   * InputError if it is not of this form. */
  void read_override(const std::string &text, Assignments &assignments);
} // namespace Impoint

#endif
