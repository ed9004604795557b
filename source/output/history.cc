#include <impoint/base/on_all_ranks.h>
#include <impoint/output/history.h>

#include <deal.II/base/exceptions.h>

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



  void HistoryWriter::resume(const std::size_t n_rows)
  {
    if (n_rows > 0)
      on_root(comm, [&]() { cut(n_rows); });
  }



  void HistoryWriter::cut(const std::size_t n_rows)
  {
    std::ifstream old(path);
    std::string   kept, line;
    std::size_t   n_lines = 0;
    while (n_lines < n_rows + 1 && std::getline(old, line) && !old.eof())
      {
        if (n_lines++ == 0)
          header = line;
        kept += line + '\n';
      }
    if (n_lines < n_rows + 1)
      throw InputError("the history '" + path + "' has fewer rows than the " +
                         std::to_string(n_rows) + " steps of the checkpoint",
                       "option --resume",
                       "Run the scene from its beginning.");
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
    std::string names, values, separator;
    for (const auto &[name, value] : row)
      {
        names += separator + csv_name(name);
        values += separator + csv_number(value);
        separator = ",";
      }
    if (header.empty())
      {
        header = names;
        file.open(path, std::ios::trunc);
        values = names + '\n' + values;
      }
    if (names != header)
      throw RunFailed("the columns of '" + path + "' are not those of the run");

    // in one piece, so that no part of a row reaches the disk alone
    values += '\n';
    file.write(values.data(), values.size());
    file.flush();
    if (!file)
      throw cannot_write(path);
  }
} // namespace Impoint
