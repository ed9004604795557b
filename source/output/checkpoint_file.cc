#include <impoint/base/on_all_ranks.h>
#include <impoint/output/checkpoint_file.h>

#include <fcntl.h>
#include <unistd.h>

#include <algorithm>
#include <cstdint>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <optional>

namespace Impoint
{
  namespace fs = std::filesystem;

  namespace
  {
    // The file: this line, of each rank the size of its piece and the piece,
    // and the checksum of all that.
    const std::string first_line = "impoint checkpoint, format 1\n";

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
        put(first_line.data(), first_line.size());
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



    /** Newest first: the names end in digits of one length. */
    std::vector<fs::path> checkpoints_in(const fs::path &folder)
    {
      std::vector<fs::path> files;
      std::error_code       ignored;
      for (const auto &entry : fs::directory_iterator(folder, ignored))
        if (entry.path().extension() == ".state")
          files.push_back(entry.path());
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
      for (const auto &entry : fs::directory_iterator(folder, ignored))
        if (entry.path().extension() == ".part")
          files.push_back(entry.path());
      for (const auto &file : files)
        fs::remove(file, ignored);
    }



    /** The pieces of a file, nothing if it is not complete. */
    std::optional<std::vector<std::string>> read_pieces(const fs::path &path)
    {
      std::ifstream     file(path, std::ios::binary);
      const std::string all((std::istreambuf_iterator<char>(file)),
                            std::istreambuf_iterator<char>());
      const std::size_t start = first_line.size();
      if (all.size() < start + sizeof(Number) ||
          all.compare(0, start, first_line) != 0)
        return {};
      const std::size_t end = all.size() - sizeof(Number);
      Checksum          checksum;
      checksum.add(all.data(), end);
      const auto number_at = [&](const std::size_t place) {
        Number number;
        std::memcpy(&number, all.data() + place, sizeof(number));
        return number;
      };
      if (number_at(end) != checksum.value())
        return {};

      std::vector<std::string> pieces;
      for (std::size_t place = start; place < end;)
        {
          const Number size = number_at(place);
          pieces.push_back(all.substr(place + sizeof(size), size));
          place += sizeof(size) + size;
        }
      return pieces;
    }
  } // namespace



  void write_checkpoint(const OutputFolder &folder,
                        const std::size_t   step,
                        const std::string  &piece)
  {
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
      if (fs::exists(history))
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
    StoredState state;
    on_all_ranks(folder.communicator(), [&]() {
      for (const auto &path :
           checkpoints_in(fs::path(folder.path()) / "checkpoint"))
        {
          if (auto pieces = read_pieces(path))
            {
              state.pieces = std::move(*pieces);
              return;
            }
          state.damaged.push_back(path.string());
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
    return state;
  }
} // namespace Impoint
