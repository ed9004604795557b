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

    const std::regex
      result_vtu_file("(points|boundary|grid)-[0-9]+\\.vtu(\\.part)?");

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
        return {
          "the folder '" + path + "' already holds the results of a run",
          "Set another folder, or allow to replace them with --overwrite."};
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
          if (fs::is_directory(fs::path(path) / "vtu"))
            for (const auto &entry :
                 fs::directory_iterator(fs::path(path) / "vtu"))
              if (std::regex_match(entry.path().filename().string(),
                                   result_vtu_file))
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

    /** Throws on all ranks what rank 0 found. */
    void throw_on_all_ranks(const FolderProblem &found,
                            const std::string   &place,
                            const MPI_Comm       communicator)
    {
      const std::string wrong =
        Utilities::MPI::broadcast(communicator, found.wrong);
      const std::string advice =
        Utilities::MPI::broadcast(communicator, found.advice);
      if (!wrong.empty())
        throw InputError(wrong, place, advice);
    }
  } // namespace



  void on_root(const MPI_Comm communicator, const std::function<void()> &action)
  {
    std::string message;
    if (Utilities::MPI::this_mpi_process(communicator) == 0)
      try
        {
          action();
        }
      catch (const std::exception &error)
        {
          message = error.what();
        }
    message = Utilities::MPI::broadcast(communicator, message);
    if (!message.empty())
      throw RunFailed(message);
  }



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
    FolderProblem problem;
    if (Utilities::MPI::this_mpi_process(comm) == 0)
      problem = find_folder_problem(folder, overwrite);
    throw_on_all_ranks(problem, place, comm);
  }



  void OutputFolder::create() const
  {
    check();
    FolderProblem problem;
    if (Utilities::MPI::this_mpi_process(comm) == 0)
      problem = prepare_folder(folder);
    throw_on_all_ranks(problem, place, comm);
  }



  void OutputFolder::write(const std::string &name,
                           const std::string &content) const
  {
    on_root(comm, [&]() { write_atomically(folder + "/" + name, content); });
  }
} // namespace Impoint
