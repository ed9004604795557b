#include <impoint/base/on_all_ranks.h>
#include <impoint/base/words.h>
#include <impoint/output/history.h>

#include <cstdio>

namespace Impoint
{
  namespace
  {
    /** A name as a cell of a CSV file: quoted where commas or quotes stand. */
    std::string csv_name(const std::string &name)
    {
      if (name.find_first_of(",\"\n") == std::string::npos)
        return name;
      std::string quoted = "\"";
      for (const char letter : name)
        quoted +=
          (letter == '"' ? std::string("\"\"") : std::string(1, letter));
      return quoted + '"';
    }

    std::string csv_number(const double value)
    {
      char text[32];
      std::snprintf(text, sizeof(text), "%.17g", value);
      return text;
    }
  } // namespace



  HistoryWriter::HistoryWriter(const OutputFolder &folder)
    : path(folder.path() + "/history.csv")
    , comm(folder.communicator())
  {}



  void HistoryWriter::begin(const std::vector<std::string> &columns,
                            const std::size_t               n_rows)
  {
    std::vector<std::string> names;
    for (const auto &column : columns)
      names.push_back(csv_name(column));
    header = Words::join(names, ",");
    on_root(comm, [&]() {
      if (n_rows > 0)
        return cut(n_rows);
      file.open(path, std::ios::trunc);
      put(header);
    });
  }



  void HistoryWriter::cut(const std::size_t n_rows)
  {
    const auto refuse = [&](const std::string &wrong) {
      throw InputError("the history '" + path + "' has " + wrong,
                       "option --resume",
                       "Run the scene from its beginning.");
    };
    std::ifstream old(path);
    std::string   kept, line;
    std::size_t   n_lines = 0;
    while (n_lines < n_rows + 1 && std::getline(old, line) && !old.eof())
      {
        if (n_lines++ == 0 && line != header)
          refuse("other columns than the scene");
        kept += line + '\n';
      }
    if (n_lines < n_rows + 1)
      refuse("fewer rows than the " + std::to_string(n_rows) +
             " steps of the checkpoint");
    old.close();
    write_atomically(path, kept);
    file.open(path, std::ios::app);
  }



  void HistoryWriter::write(const HistoryRow &row)
  {
    on_root(comm, [&]() { append(row); });
  }



  void HistoryWriter::append(const HistoryRow &row)
  {
    std::string values, separator;
    for (const auto &column : row)
      {
        values += separator + csv_number(column.second);
        separator = ",";
      }
    put(values);
  }



  /** In one piece, so that no part of a line reaches the disk alone. */
  void HistoryWriter::put(const std::string &line)
  {
    const std::string text = line + '\n';
    file.write(text.data(), text.size());
    file.flush();
    if (!file)
      throw cannot_write(path);
  }
} // namespace Impoint
