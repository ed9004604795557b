#include <impoint/output/results_table.h>

#include <algorithm>
#include <cstdio>
#include <sstream>

namespace Impoint
{
  namespace
  {
    /** Number of columns: bytes that continue a UTF-8 letter take none. */
    unsigned int width_of(const std::string &text)
    {
      return std::count_if(text.begin(),
                           text.end(),
                           [](const unsigned char byte) {
                             return (byte & 0xC0) != 0x80;
                           });
    }

    std::string right_aligned(const char *format, const double value)
    {
      char text[32];
      std::snprintf(text, sizeof(text), format, value);
      return std::string(std::max(0, 15 - static_cast<int>(width_of(text))),
                         ' ') +
             text;
    }

    std::string result_line(const Result &result, const unsigned int name_width)
    {
      std::string line = "  " + padded(result.name, name_width);
      line += right_aligned("%.7g", result.value);
      if (!std::isnan(result.reference))
        line +=
          right_aligned("%.7g", result.reference) +
          right_aligned(result.error() == 0 ? "%g" : "%.1e", result.error());
      return line + '\n';
    }

    bool has_reference(const Result &result)
    {
      return !std::isnan(result.reference);
    }
  } // namespace



  std::string padded(const std::string &text, const unsigned int width)
  {
    const unsigned int used = width_of(text);
    return text + std::string(used < width ? width - used : 0, ' ');
  }



  std::string wrapped(const std::string &text, const unsigned int indent)
  {
    std::istringstream lines(text);
    std::string        result;
    for (std::string line; std::getline(lines, line); result += '\n')
      {
        const std::size_t content =
          std::min(line.find_first_not_of(' '), line.size());
        std::istringstream words(line.substr(content));
        std::string        broken(content, ' ');
        unsigned int       used = content;
        for (std::string word, separator; words >> word; separator = " ")
          {
            if (!separator.empty() &&
                used + 1 + width_of(word) > terminal_columns)
              {
                broken += '\n' + std::string(indent, ' ');
                used = indent;
                separator.clear();
              }
            broken += separator + word;
            used += separator.size() + width_of(word);
          }
        result += broken;
      }
    return result;
  }



  std::string results_table(const std::vector<Result> &results)
  {
    if (results.empty())
      return "";
    unsigned int name_width = width_of("result");
    for (const Result &result : results)
      name_width = std::max(name_width, width_of(result.name));
    // longer names push their numbers to the right, alone
    name_width = std::min(name_width, terminal_columns - 2 - 3 * 15);

    std::string head = padded("result", name_width) + padded("", 10) + "value";
    if (std::any_of(results.begin(), results.end(), has_reference))
      head += padded("", 6) + "reference" + padded("", 10) + "error";
    std::string table =
      "  " + head + "\n  " + std::string(head.size(), '-') + '\n';
    for (const Result &result : results)
      table += result_line(result, name_width);
    return table;
  }



  std::string duration(const double seconds)
  {
    char text[32];
    if (seconds < 60)
      std::snprintf(text,
                    sizeof(text),
                    seconds < 10 ? "%.2g s" : "%.0f s",
                    seconds);
    else
      {
        const bool     hours = seconds >= 3600;
        const long int parts = std::lround(hours ? seconds / 60 : seconds);
        std::snprintf(text,
                      sizeof(text),
                      "%ld:%02ld %s",
                      parts / 60,
                      parts % 60,
                      hours ? "h" : "min");
      }
    return text;
  }
} // namespace Impoint
