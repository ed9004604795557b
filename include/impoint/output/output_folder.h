#ifndef impoint_output_output_folder_h
#define impoint_output_output_folder_h

#include <impoint/base/exceptions.h>

#include <deal.II/base/mpi.h>

#include <functional>
#include <string>

namespace Impoint
{
  using namespace dealii;

  /** The error of a file that could just now not be written. */
  RunFailed cannot_write(const std::string &path);

  /**
   * Writes a small file under another name, then renames it: readers see the
   * old content or the new, never a part. Throws RunFailed.
   */
  void write_atomically(const std::string &path, const std::string &content);

  /** Hands the @p piece of each rank in turn to @p take on rank 0, which must
   * not throw. Collective. */
  void collect_on_root(const std::string                              &piece,
                       const MPI_Comm                                  comm,
                       const std::function<void(const std::string &)> &take);

  /**
   * The folder of a run's results. All members are collective, files are
   * touched by rank 0 alone.
   */
  class OutputFolder
  {
  public:
    /**
     * Touches nothing. @p place says where the user set @p path, for messages
     * (ParameterFile::place()).
     */
    OutputFolder(const std::string &path,
                 const bool         overwrite,
                 const MPI_Comm     communicator,
                 const std::string &place = "the output folder");

    /**
     * Leaves nothing. Throws InputError if the folder cannot be made or written
     * to, or if it holds results that may not be overwritten.
     */
    void check() const;

    /**
     * Checks, then makes the folder with its parents, or removes the results
     * of the earlier run from it; other files stay. Throws InputError.
     */
    void create() const;

    /** Replaces the file @p name in the folder by @p content. */
    void write(const std::string &name, const std::string &content) const;

    const std::string &path() const
    {
      return folder;
    }

    MPI_Comm communicator() const
    {
      return comm;
    }

  private:
    std::string folder;
    std::string place;
    bool        overwrite;
    MPI_Comm    comm;
  };
} // namespace Impoint

#endif
