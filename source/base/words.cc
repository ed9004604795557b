#include <impoint/base/words.h>

#include <algorithm>
#include <cctype>
#include <cstdio>
#include <cstdlib>

namespace Impoint
{
  namespace
  {
    bool letters_equal(const char left, const char right)
    {
      return std::tolower(static_cast<unsigned char>(left)) ==
             std::tolower(static_cast<unsigned char>(right));
    }



    // Blanks and dashes do not count when names are compared.
    std::string without_separators(const std::string &name)
    {
      std::string letters;
      for (const char letter : name)
        if (std::string(" -_").find(letter) == std::string::npos)
          letters += letter;
      return letters;
    }



    // Letters to insert, remove, replace or swap with their neighbour; case
    // does not count.
    unsigned int edit_distance(const std::string &from, const std::string &to)
    {
      std::vector<std::vector<unsigned int>> distance(
        from.size() + 1, std::vector<unsigned int>(to.size() + 1));
      for (unsigned int i = 0; i <= from.size(); ++i)
        for (unsigned int j = 0; j <= to.size(); ++j)
          {
            if (i == 0 || j == 0)
              {
                distance[i][j] = i + j;
                continue;
              }
            const bool equal = letters_equal(from[i - 1], to[j - 1]);
            distance[i][j]   = std::min({distance[i - 1][j] + 1,
                                         distance[i][j - 1] + 1,
                                         distance[i - 1][j - 1] + !equal});
            if (i > 1 && j > 1 && letters_equal(from[i - 1], to[j - 2]) &&
                letters_equal(from[i - 2], to[j - 1]))
              distance[i][j] =
                std::min(distance[i][j], distance[i - 2][j - 2] + 1);
          }
      return distance[from.size()][to.size()];
    }



    std::string between(const std::string &text,
                        const std::string &before,
                        const std::string &after)
    {
      const auto start = text.find(before);
      if (start == std::string::npos)
        return "";
      const auto begin = start + before.size();
      return text.substr(begin, text.rfind(after) - begin);
    }



    // deal.II writes "low...high (inclusive)"; a bound that is a limit of the
    // type is no bound.
    std::string bounded(const std::string &noun, const std::string &description)
    {
      const auto dots = description.find("...");
      if (dots == std::string::npos)
        return noun;
      const auto start = description.rfind(' ', dots) + 1;
      const auto low   = description.substr(start, dots - start);
      const auto high =
        description.substr(dots + 3, description.find(' ', dots) - dots - 3);
      const bool positive =
        std::atof(low.c_str()) > 0 && std::atof(low.c_str()) <= 1e-300;
      const bool has_low  = low != "-MAX_DOUBLE" && low != "-2147483648";
      const bool has_high = high != "MAX_DOUBLE" && high != "2147483647";

      if (positive)
        return noun + " above 0" + (has_high ? " and at most " + high : "");
      if (has_low && has_high)
        return low == high ? noun + " equal to " + low :
                             noun + " from " + low + " to " + high;
      if (has_low)
        return noun + " of at least " + low;
      return has_high ? noun + " of at most " + high : noun;
    }



    std::string allowed_list(const std::string &description)
    {
      const auto  length = between(description, "> of length ", " (inclusive)");
      const auto  dots   = length.find("...");
      const auto  low    = length.substr(0, dots);
      const auto  high   = length.substr(dots + 3);
      const auto  separator = between(description, "separated by <", ">");
      std::string count     = low == "0" ? "" : low + " or more ";
      if (high != "4294967295")
        count = low == high ? low + " " : low + " to " + high + " ";
      return count + "values separated by '" +
             (separator.empty() ? "," : separator) + "', each " +
             Words::allowed(between(description, " of <", "> of length"));
    }
  } // namespace



  namespace Words
  {
    std::string trim(const std::string &text)
    {
      const std::string blanks = " \t\r\n\v\f";
      const auto        begin  = text.find_first_not_of(blanks);
      if (begin == std::string::npos)
        return "";
      return text.substr(begin, text.find_last_not_of(blanks) - begin + 1);
    }



    std::vector<std::string> split(const std::string &text,
                                   const char         separator)
    {
      std::vector<std::string> parts;
      if (trim(text).empty())
        return parts;
      std::string::size_type begin = 0, end;
      while ((end = text.find(separator, begin)) != std::string::npos)
        {
          parts.push_back(trim(text.substr(begin, end - begin)));
          begin = end + 1;
        }
      parts.push_back(trim(text.substr(begin)));
      return parts;
    }



    std::string join(const std::vector<std::string> &parts,
                     const std::string              &separator)
    {
      std::string text;
      for (const auto &part : parts)
        text += (text.empty() ? "" : separator) + part;
      return text;
    }



    std::string nearest(const std::string              &name,
                        const std::vector<std::string> &candidates)
    {
      std::string  best;
      unsigned int best_distance = name.size() / 3 + 2;
      for (const auto &candidate : candidates)
        {
          const unsigned int distance =
            edit_distance(without_separators(name),
                          without_separators(candidate));
          if (distance < best_distance &&
              distance < std::max(name.size(), candidate.size()))
            {
              best_distance = distance;
              best          = candidate;
            }
        }
      return best;
    }



    std::string suggestion(const std::string              &name,
                           const std::vector<std::string> &candidates,
                           const std::string              &introduction)
    {
      const std::string near = nearest(name, candidates);
      if (!near.empty())
        return "Did you mean '" + near + "'?";
      return introduction + " " + join(candidates, ", ") + ".";
    }



    std::string allowed(const std::string &description)
    {
      const auto is = [&](const std::string &kind) {
        return description.rfind("[" + kind, 0) == 0;
      };
      if (is("Double"))
        return bounded("a number", description);
      if (is("Integer"))
        return bounded("an integer", description);
      if (is("Bool"))
        return "true or false";
      if (is("Selection"))
        return "one of " + join(choices(description), ", ");
      if (is("MultipleSelection"))
        return "some of " +
               join(split(between(description, "[MultipleSelection ", " ]"),
                          '|'),
                    ", ") +
               ", separated by ','";
      if (is("List"))
        return allowed_list(description);
      if (is("FileName"))
        return "the name of a file";
      if (is("DirectoryName"))
        return "the name of a folder";
      return is("Anything") ? "a text" : description;
    }



    std::vector<std::string> choices(const std::string &description)
    {
      if (description == "[Bool]")
        return {"true", "false"};
      return split(between(description, "[Selection ", " ]"), '|');
    }



    std::string with_point(const std::string &text,
                           const std::string &description)
    {
      const auto comma = text.find(',');
      if (description.rfind("[Double", 0) != 0 || comma == std::string::npos)
        return "";
      std::string number = text;
      number[comma]      = '.';
      char *rest         = nullptr;
      std::strtod(number.c_str(), &rest);
      return *rest == '\0' ? number : "";
    }



    std::string last_part(const std::string &path)
    {
      return path.substr(path.rfind('/') + 1);
    }



    std::string parent(const std::string &path)
    {
      const auto slash = path.rfind('/');
      return slash == std::string::npos ? "" : path.substr(0, slash);
    }



    std::string entry(const std::string &path)
    {
      const std::string section = parent(path);
      return "entry '" + last_part(path) + "'" +
             (section.empty() ? "" : " in section '" + section + "'");
    }



    std::string exact(const double number)
    {
      char text[32];
      for (int digits = 6; digits <= 17; ++digits)
        {
          std::snprintf(text, sizeof(text), "%.*g", digits, number);
          if (std::strtod(text, nullptr) == number)
            break;
        }
      return text;
    }
  } // namespace Words
} // namespace Impoint
