#include <impoint/base/on_all_ranks.h>
#include <impoint/output/checkpoint_file.h>

#include <boost/serialization/utility.hpp>
#include <fcntl.h>
#include <unistd.h>

#include <algorithm>
#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <optional>

namespace Impoint
{
  namespace fs = std::filesystem;

  namespace
  {
    // The file: a line with this and the format; of each rank the size of its
    // piece and the piece, which is the run's and the particles' bytes, each
    // after their number; the checksum of all that. The format is that of all
    // the bytes: what changes them, here or in what a run stores of itself,
    // raises it.
    const std::string first_words = "impoint checkpoint, format ";
    const std::string format      = "3";

    using Number = std::uint64_t;

    /** The 64-bit FNV-1a hash, which tells damaged files from whole ones. */
    class Checksum
    {
    public:
      void add(const char *bytes, const std::size_t n)
      {
        for (std::size_t i = 0; i < n; ++i)
          hash = (hash ^ static_cast<unsigned char>(bytes[i])) *
                 Number(1099511628211u);
      }

      Number value() const
      {
        return hash;
      }

    private:
      Number hash = 14695981039346656037u;
    };



    void to_disk(const std::string &path)
    {
      const int  descriptor = open(path.c_str(), O_RDONLY);
      const bool done       = descriptor >= 0 && fsync(descriptor) == 0;
      if (descriptor >= 0)
        close(descriptor);
      if (!done)
        throw cannot_write(path);
    }



    /** Rank 0's file on its way. */
    class CheckpointWriter
    {
    public:
      explicit CheckpointWriter(const std::string &path)
        : file(path, std::ios::binary | std::ios::trunc)
      {
        const std::string line = first_words + format + '\n';
        put(line.data(), line.size());
      }

      void put_piece(const std::string &piece)
      {
        const Number size = piece.size();
        put(reinterpret_cast<const char *>(&size), sizeof(size));
        put(piece.data(), piece.size());
      }

      bool finish()
      {
        const Number sum = checksum.value();
        put(reinterpret_cast<const char *>(&sum), sizeof(sum));
        file.close();
        return bool(file);
      }

    private:
      void put(const char *bytes, const std::size_t n)
      {
        checksum.add(bytes, n);
        file.write(bytes, n);
      }

      std::ofstream file;
      Checksum      checksum;
    };



    std::string file_of_step(const std::size_t step)
    {
      char name[64];
      std::snprintf(name, sizeof(name), "step-%09zu.state", step);
      return name;
    }



    /** What cannot be read holds none. */
    std::vector<fs::path> files_in(const fs::path    &folder,
                                   const std::string &extension)
    {
      std::vector<fs::path> files;
      std::error_code       failed;
      for (fs::directory_iterator entry(folder, failed), end;
           !failed && entry != end;
           entry.increment(failed))
        if (entry->path().extension() == extension)
          files.push_back(entry->path());
      return files;
    }



    /** Newest first: the names end in digits of one length. */
    std::vector<fs::path> checkpoints_in(const fs::path &folder)
    {
      auto files = files_in(folder, ".state");
      std::sort(files.rbegin(), files.rend());
      return files;
    }



    /** All but the newest two, and what killed runs left of others. */
    void remove_old(const fs::path &folder)
    {
      std::error_code ignored; // then they stay
      auto            files = checkpoints_in(folder);
      files.erase(files.begin(),
                  files.begin() + std::min<std::size_t>(2, files.size()));
      const auto parts = files_in(folder, ".part");
      files.insert(files.end(), parts.begin(), parts.end());
      for (const auto &file : files)
        fs::remove(file, ignored);
    }



    /** Reads a file from its start, a little at a time. */
    class CheckpointReader
    {
    public:
      explicit CheckpointReader(const std::string &path)
        : file(path, std::ios::binary)
        , path(path)
      {
        std::error_code ignored;
        const auto      n_bytes = fs::file_size(path, ignored);
        left                    = ignored ? 0 : n_bytes;
      }

      /** The format; none if the first words are others. */
      std::string start()
      {
        std::string words(first_words.size(), ' '), number;
        if (!take(words.data(), words.size()) || words != first_words)
          return "";
        for (char letter; number.size() < 20 && take(&letter, 1);)
          {
            if (letter == '\n')
              return number;
            number += letter;
          }
        return "";
      }

      /** The sum of all before it is at the end. */
      bool ends_right()
      {
        const Number expected = checksum.value();
        return number() == expected && left == 0;
      }

      bool has_pieces() const
      {
        return left > sizeof(Number);
      }

      Number number()
      {
        Number value = 0;
        return take(reinterpret_cast<char *>(&value), sizeof(value)) ? value :
                                                                       left + 1;
      }

      /** Passes over a number and as many bytes; nothing if there are less. */
      std::optional<StoredPieces::Extent> skip()
      {
        const Number size = number();
        if (size > left)
          return {};
        const StoredPieces::Extent extent(place, size);
        for (Number rest = size; rest > 0;)
          {
            const Number n = std::min<Number>(rest, block.size());
            if (!take(block.data(), n))
              return {};
            rest -= n;
          }
        return extent;
      }

    private:
      bool take(char *bytes, const Number n)
      {
        if (n > left || !file.read(bytes, n))
          return false;
        checksum.add(bytes, n);
        left -= n;
        place += n;
        return true;
      }

      std::ifstream     file;
      const std::string path;
      Number            place = 0, left = 0;
      std::vector<char> block = std::vector<char>(1 << 20);
      Checksum          checksum;
    };



    /** Where the run and the particles of each rank are in a file; nothing if
     * it is not complete. Throws InputError if it is of another format. */
    std::vector<StoredPieces::Extent> find_parts(const std::string &path)
    {
      CheckpointReader                  file(path);
      std::vector<StoredPieces::Extent> parts;
      const std::string                 written = file.start();
      if (written.empty())
        return {};
      if (written != format)
        throw InputError("the checkpoint '" + path + "' has format " + written +
                           ", this version of impoint (" IMPOINT_VERSION
                           ") reads and writes format " +
                           format,
                         "option --resume",
                         "Resume with the version that wrote it, or run the "
                         "scene from its beginning.");
      while (file.has_pieces())
        {
          const Number size = file.number();
          const auto   run = file.skip(), particles = file.skip();
          if (!run || !particles ||
              size != 2 * sizeof(Number) + run->second + particles->second)
            return {};
          parts.insert(parts.end(), {*run, *particles});
        }
      if (!file.ends_right())
        return {};
      return parts;
    }
  } // namespace



  void write_checkpoint(const OutputFolder &folder,
                        const std::size_t   step,
                        const std::string  &run,
                        const std::string  &particles)
  {
    std::string piece;
    piece.reserve(2 * sizeof(Number) + run.size() + particles.size());
    for (const std::string *part : {&run, &particles})
      {
        const Number size = part->size();
        piece.append(reinterpret_cast<const char *>(&size), sizeof(size));
        piece += *part;
      }
    const fs::path    target = fs::path(folder.path()) / "checkpoint";
    const std::string path   = (target / file_of_step(step)).string();
    const std::string part   = path + ".part";
    std::optional<CheckpointWriter> writer;
    on_root(folder.communicator(), [&]() {
      std::error_code ignored; // the file cannot be opened then, either
      fs::create_directory(target, ignored);
      writer.emplace(part);
    });
    collect_on_root(piece,
                    folder.communicator(),
                    [&](const std::string &of_rank) {
                      writer->put_piece(of_rank);
                    });
    on_root(folder.communicator(), [&]() {
      if (!writer->finish())
        throw cannot_write(part);
      // A checkpoint counts on as many rows of the history as it has steps.
      const std::string history = folder.path() + "/history.csv";
      std::error_code   ignored;
      if (fs::exists(history, ignored))
        to_disk(history);
      to_disk(part);
      if (std::rename(part.c_str(), path.c_str()) != 0)
        throw cannot_write(path);
      to_disk(target.string());
      remove_old(target);
    });
  }



  StoredState read_newest_checkpoint(const OutputFolder &folder)
  {
    const MPI_Comm                    comm = folder.communicator();
    StoredState                       state;
    std::string                       path;
    std::vector<StoredPieces::Extent> parts;
    on_root(comm, [&]() {
      for (const auto &file :
           checkpoints_in(fs::path(folder.path()) / "checkpoint"))
        {
          path  = file.string();
          parts = find_parts(path);
          if (!parts.empty())
            return;
          state.damaged.push_back(path);
        }
      throw InputError(
        state.damaged.empty() ?
          "the folder '" + folder.path() + "' holds no checkpoint" :
          "the checkpoint '" + state.damaged[0] +
            "' is damaged: it is cut "
            "short or was altered",
        "option --resume",
        "Run the scene from its beginning; 'Checkpoint every' and 'Checkpoint "
        "minutes' in section 'Output' say when checkpoints are written.");
    });
    path          = Utilities::MPI::broadcast(comm, path);
    parts         = Utilities::MPI::broadcast(comm, parts);
    state.damaged = Utilities::MPI::broadcast(comm, state.damaged);
    on_all_ranks(comm, [&]() { state.run = read_bytes(path, parts[0]); });
    std::vector<StoredPieces::Extent> particles;
    for (std::size_t i = 1; i < parts.size(); i += 2)
      particles.push_back(parts[i]);
    state.particles = StoredPieces(path, particles);
    return state;
  }
} // namespace Impoint
