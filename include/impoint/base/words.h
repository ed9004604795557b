#ifndef impoint_base_words_h
#define impoint_base_words_h

#include <string>
#include <vector>

namespace Impoint
{
  /** Small things that messages and readers of text need. */
  namespace Words
  {
    /** @p text without blanks at its ends. */
    std::string trim(const std::string &text);

    /** The parts of @p text between the separators, trimmed; an empty part
     * stays, an empty text has none. */
    std::vector<std::string> split(const std::string &text,
                                   const char         separator);

    /** @p parts with @p separator between them. */
    std::string join(const std::vector<std::string> &parts,
                     const std::string              &separator);

    /**
     * The member of @p candidates that @p name most likely misspells, or
     * nothing if none differs in less than about a third of its letters.
     */
    std::string nearest(const std::string              &name,
                        const std::vector<std::string> &candidates);

    /** "Did you mean 'x'?" if some name is near, else "@p introduction a, b,
     * c." */
    std::string suggestion(const std::string              &name,
                           const std::vector<std::string> &candidates,
                           const std::string              &introduction);

    /**
     * What a pattern allows, said to a person, from the description that
     * deal.II gives of it: "[Double 0...MAX_DOUBLE (inclusive)]" is "a number
     * of at least 0".
     */
    std::string allowed(const std::string &description);

    /** The words a pattern of this description allows; none if it allows
     * others. */
    std::vector<std::string> choices(const std::string &description);

    /** The number that @p text is if its comma is a decimal point, where one
     * number is allowed (@p description as above); else nothing. */
    std::string with_point(const std::string &text,
                           const std::string &description);

    /** "E" of the path "A/B/E". */
    std::string last_part(const std::string &path);

    /** "A/B" of the path "A/B/E", nothing of "E". */
    std::string parent(const std::string &path);

    /** "entry 'E' in section 'A/B'" for the path "A/B/E". */
    std::string entry(const std::string &path);

    /** The shortest decimal text from which @p number can be read back exactly.
     */
    std::string exact(const double number);
  } // namespace Words
} // namespace Impoint

#endif
