#include <impoint/base/on_all_ranks.h>
#include <impoint/output/output_folder.h>

#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <regex>

namespace Impoint
{
  namespace
  {
    /** What an InputError says of a folder; nothing wrong: empty. */
    struct FolderProblem
    {
      std::string wrong, advice;
    };

    const char *const result_files[] = {"parameters.prm",
                                        "history.csv",
                                        "summary.json",
                                        "points.pvd",
                                        "boundary.pvd",
                                        "grid.pvd"};

    // folders in it, and which files in them are results
    const std::pair<const char *, std::regex> result_folders[] = {
      {"vtu", std::regex("(points|boundary|grid)-[0-9]+\\.vtu(\\.part)?")},
      {"checkpoint", std::regex("step-[0-9]+\\.state(\\.part)?")}};

    /** Whether there is something at @p path, as far as one may look. */
    bool is_there(const std::filesystem::path &path)
    {
      std::error_code ignored;
      return std::filesystem::exists(path, ignored);
    }

    bool holds_results(const std::filesystem::path &folder)
    {
      for (const char *name : {"parameters.prm", "history.csv", "summary.json"})
        if (is_there(folder / name))
          return true;
      return false;
    }

    FolderProblem find_folder_problem(const std::string &path,
                                      const bool         overwrite)
    {
      if (path.empty())
        return {"the output folder has no name", "Set the path of a folder."};

      std::filesystem::path existing = path;
      while (!is_there(existing) && existing.has_relative_path())
        existing = existing.parent_path();
      if (existing.empty())
        existing = ".";
      std::error_code ignored;
      if (!std::filesystem::is_directory(existing, ignored))
        return {"'" + path + "' cannot be a folder: '" + existing.string() +
                  "' is a file",
                "Set another folder."};
      if (access(existing.c_str(), W_OK | X_OK) != 0)
        return {"'" + path + "' cannot be written: '" + existing.string() +
                  "' says: " + std::strerror(errno),
                "Set a folder that you may write to."};
      if (!overwrite && holds_results(path))
        return {"the folder '" + path + "' already holds the results of a run",
                "Give another one with --output FOLDER, or replace them with "
                "--overwrite."};
      return {};
    }

    FolderProblem prepare_folder(const std::string &path)
    {
      namespace fs = std::filesystem;
      try
        {
          fs::create_directories(path);
          for (const char *name : result_files)
            fs::remove(fs::path(path) / name);
          for (const auto &[name, files] : result_folders)
            if (fs::is_directory(fs::path(path) / name))
              for (const auto &entry :
                   fs::directory_iterator(fs::path(path) / name))
                if (std::regex_match(entry.path().filename().string(), files))
                  fs::remove(entry.path());
        }
      catch (const fs::filesystem_error &error)
        {
          return {"'" + path + "' cannot be prepared: '" +
                    error.path1().string() +
                    "' says: " + error.code().message(),
                  "Set a folder that you may write to."};
        }
      return {};
    }

    void complain_of(const FolderProblem &found, const std::string &place)
    {
      if (!found.wrong.empty())
        throw InputError(found.wrong, place, found.advice);
    }
  } // namespace



  RunFailed cannot_write(const std::string &path)
  {
    return RunFailed("The file '" + path +
                     "' cannot be written: " + std::strerror(errno) + ".");
  }



  void write_atomically(const std::string &path, const std::string &content)
  {
    const std::string part = path + ".part";
    std::ofstream     file(part, std::ios::binary | std::ios::trunc);
    file.write(content.data(), content.size());
    file.close();
    if (!file || std::rename(part.c_str(), path.c_str()) != 0)
      throw cannot_write(path);
  }



  void collect_on_root(const std::string                              &piece,
                       const MPI_Comm                                  comm,
                       const std::function<void(const std::string &)> &take)
  {
    const int tag = 271;
    if (Utilities::MPI::this_mpi_process(comm) != 0)
      {
        MPI_Send(piece.data(), piece.size(), MPI_CHAR, 0, tag, comm);
        return;
      }
    take(piece);
    std::string received;
    for (unsigned int rank = 1; rank < Utilities::MPI::n_mpi_processes(comm);
         ++rank)
      {
        MPI_Status status;
        int        size = 0;
        MPI_Probe(rank, tag, comm, &status);
        MPI_Get_count(&status, MPI_CHAR, &size);
        received.resize(size);
        MPI_Recv(
          received.data(), size, MPI_CHAR, rank, tag, comm, MPI_STATUS_IGNORE);
        take(received);
      }
  }



  OutputFolder::OutputFolder(const std::string &path,
                             const bool         overwrite,
                             const MPI_Comm     communicator,
                             const std::string &place)
    : folder(path)
    , place(place)
    , overwrite(overwrite)
    , comm(communicator)
  {}



  void OutputFolder::check() const
  {
    on_root(comm, [&]() {
      complain_of(find_folder_problem(folder, overwrite), place);
    });
  }



  void OutputFolder::create() const
  {
    check();
    on_root(comm, [&]() { complain_of(prepare_folder(folder), place); });
  }



  void OutputFolder::write(const std::string &name,
                           const std::string &content) const
  {
    on_root(comm, [&]() { write_atomically(folder + "/" + name, content); });
  }
} // namespace Impoint
