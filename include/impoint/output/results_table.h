#ifndef impoint_output_results_table_h
#define impoint_output_results_table_h

#include <impoint/output/run_record.h>

#include <string>
#include <vector>

namespace Impoint
{
  /** Lines of text on the terminal are no longer than this. */
  constexpr unsigned int terminal_columns = 100;

  /** The aligned table of name, value, reference and error, without the last
   * two where no result has a reference. Empty without results. */
  std::string results_table(const std::vector<Result> &results);

  /** @p text (UTF-8) with blanks up to @p width columns. */
  std::string padded(const std::string &text, const unsigned int width);

  /** @p text broken at blanks into lines of terminal_columns, those after the
   * first indented by @p indent. Line breaks of the text are kept. */
  std::string wrapped(const std::string &text, const unsigned int indent);

  /** "0.31 s", "12 s", "3:05 min", "2:10 h". */
  std::string duration(const double seconds);
} // namespace Impoint

#endif
