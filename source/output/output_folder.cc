#include <impoint/base/on_all_ranks.h>
#include <impoint/output/output_folder.h>

#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstdint>
#include <cstdlib>
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

    /** Tries it: root may write to all folders, and yet not to /proc. */
    bool can_be_written(const std::filesystem::path &folder)
    {
      std::string trial = (folder / ".impoint-XXXXXX").string();
      return mkdtemp(trial.data()) != nullptr && rmdir(trial.c_str()) == 0;
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
      if (!can_be_written(existing))
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
    const int         tag            = 271;
    const std::size_t in_chunk       = 1 << 24; // MPI counts by int
    std::uint64_t     n_bytes        = piece.size();
    const auto        for_each_chunk = [&](const auto &action) {
      for (std::uint64_t done = 0; done < n_bytes; done += in_chunk)
        action(done,
               static_cast<int>(
                 std::min<std::uint64_t>(in_chunk, n_bytes - done)));
    };
    if (Utilities::MPI::this_mpi_process(comm) != 0)
      {
        MPI_Send(&n_bytes, 1, MPI_UINT64_T, 0, tag, comm);
        for_each_chunk([&](const std::uint64_t done, const int n) {
          MPI_Send(piece.data() + done, n, MPI_CHAR, 0, tag, comm);
        });
        return;
      }
    take(piece);
    std::string received;
    for (unsigned int rank = 1; rank < Utilities::MPI::n_mpi_processes(comm);
         ++rank)
      {
        MPI_Status *const none = MPI_STATUS_IGNORE;
        MPI_Recv(&n_bytes, 1, MPI_UINT64_T, rank, tag, comm, none);
        received.resize(n_bytes);
        for_each_chunk([&](const std::uint64_t done, const int n) {
          MPI_Recv(received.data() + done, n, MPI_CHAR, rank, tag, comm, none);
        });
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
