#ifndef impoint_output_history_h
#define impoint_output_history_h

#include <impoint/output/output_folder.h>
#include <impoint/output/run_record.h>

#include <fstream>

namespace Impoint
{
  /**
   * Writes history.csv, a row a step.
   */
  class HistoryWriter
  {
  public:
    /** Opens nothing. */
    explicit HistoryWriter(const OutputFolder &folder);

    /** Writes the header, or goes on with the file of an earlier run after its
     * first @p n_rows rows and drops the others. Collective; throws InputError
     * if there are fewer or of other columns, or RunFailed. */
    void begin(const std::vector<std::string> &columns,
               const std::size_t               n_rows = 0);

    /**
     * Appends @p row (used on rank 0) with 17 digits and hands it to the
     * system at once: a killed run leaves complete rows. All rows have the
     * same names in the same order. Collective; throws RunFailed.
     */
    void write(const HistoryRow &row);

  private:
    void cut(const std::size_t n_rows);
    void append(const HistoryRow &row);
    void put(const std::string &line);

    std::string   path, header;
    MPI_Comm      comm;
    std::ofstream file;
  };
} // namespace Impoint

#endif
