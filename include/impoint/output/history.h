#ifndef impoint_output_history_h
#define impoint_output_history_h

#include <impoint/output/output_folder.h>
#include <impoint/output/run_record.h>

#include <fstream>

namespace Impoint
{
  /**
   * Writes history.csv, a row a step. The first row's names become the header.
   */
  class HistoryWriter
  {
  public:
    /** Opens nothing before the first row. */
    explicit HistoryWriter(const OutputFolder &folder);

    /** Goes on with the file of an earlier run after its first @p n_rows rows;
     * drops the others. Collective; throws InputError if there are fewer. */
    void resume(const std::size_t n_rows);

    /**
     * Appends @p row (used on rank 0) with 17 digits and hands it to the
     * system at once: a killed run leaves complete rows. All rows have the
     * same names in the same order. Collective; throws RunFailed.
     */
    void write(const HistoryRow &row);

  private:
    void cut(const std::size_t n_rows);
    void append(const HistoryRow &row);

    std::string   path, header;
    MPI_Comm      comm;
    std::ofstream file;
  };
} // namespace Impoint

#endif
