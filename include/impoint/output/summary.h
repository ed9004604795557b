#ifndef impoint_output_summary_h
#define impoint_output_summary_h

#include <impoint/output/output_folder.h>
#include <impoint/output/run_record.h>

namespace Impoint
{
  /**
   * Writes summary.json, a run's last words, into @p folder. Values that are
   * not finite become null, since JSON has no word for them. Collective;
   * throws RunFailed.
   */
  void write_summary(const RunRecord &record, const OutputFolder &folder);
} // namespace Impoint

#endif
