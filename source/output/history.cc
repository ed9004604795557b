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
    Assert(names == header,
           ExcMessage("Columns of history.csv change: " + names));

    // in one piece, so that no part of a row reaches the disk alone
    values += '\n';
    file.write(values.data(), values.size());
    file.flush();
    if (!file)
      throw cannot_write(path);
  }
} // namespace Impoint
