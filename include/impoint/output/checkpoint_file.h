#ifndef impoint_output_checkpoint_file_h
#define impoint_output_checkpoint_file_h

#include <impoint/base/stored_pieces.h>
#include <impoint/output/output_folder.h>

#include <cstddef>
#include <string>
#include <vector>

namespace Impoint
{
  /** What the ranks of a run wrote at the end of a step. */
  struct StoredState
  {
    std::string              run;       // of rank 0
    StoredPieces             particles; // by rank
    std::vector<std::string> damaged;   // newer files, which are not complete
  };

  /**
   * Writes checkpoint/step-STEP.state in @p folder from what each rank has of
   * the @p run, which is nothing but on rank 0, and of its @p particles. The
   * file has its name only when it is complete and on the disk; of those that
   * were there before, the newest is kept as a reserve. Collective; throws
   * RunFailed.
   */
  void write_checkpoint(const OutputFolder &folder,
                        const std::size_t   step,
                        const std::string  &run,
                        const std::string  &particles);

  /** Reads the newest checkpoint that is complete. Collective; throws
   * InputError if there is none. */
  StoredState read_newest_checkpoint(const OutputFolder &folder);
} // namespace Impoint

#endif
