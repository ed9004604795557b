#ifndef impoint_base_state_archive_h
#define impoint_base_state_archive_h

#include <impoint/base/exceptions.h>

#include <cstdint>
#include <cstring>
#include <string>
#include <type_traits>
#include <utility>

namespace Impoint
{
  /**
   * Bytes of a run's state in the machine's own format. One function states
   * what is kept, `archive & first & second`, and serves to write and to read:
   * numbers, tensors, strings, pairs and vectors of these.
   */
  class StateArchive
  {
  public:
    /** An empty one, to write into. */
    StateArchive() = default;

    /** One to read from. */
    explicit StateArchive(std::string bytes)
      : all(std::move(bytes))
      , is_read(true)
    {}

    bool reads() const
    {
      return is_read;
    }

    const std::string &bytes() const
    {
      return all;
    }

    std::size_t n_read() const
    {
      return place;
    }

    template <typename T>
    StateArchive &operator&(T &value)
    {
      if constexpr (std::is_arithmetic_v<T>)
        copy(&value, sizeof(T));
      else
        each(value, 0);
      return *this;
    }

    /** Writes @p name, or throws InputError if another one was written here. */
    void tag(const std::string &name)
    {
      std::string written = name;
      *this      &written;
      if (written != name)
        throw does_not_fit("it has '" + written.substr(0, 40) +
                           "' in place of '" + name + "'");
    }

    static InputError does_not_fit(const std::string &wrong)
    {
      return InputError("the checkpoint does not fit the scene: " + wrong,
                        "option --resume",
                        "Resume with the scene, and the version of impoint, "
                        "that wrote it.");
    }

  private:
    void copy(void *value, const std::size_t n_bytes)
    {
      if (!is_read)
        {
          all.append(static_cast<const char *>(value), n_bytes);
          return;
        }
      if (n_bytes > all.size() - place)
        throw does_not_fit("it ends early");
      if (n_bytes > 0)
        std::memcpy(value, all.data() + place, n_bytes);
      place += n_bytes;
    }

    /** Of tensors. */
    template <typename T>
    auto each(T &tensor, int) -> decltype(tensor.begin_raw(), void())
    {
      for (auto *value = tensor.begin_raw(); value != tensor.end_raw(); ++value)
        *this &*value;
    }

    template <typename A, typename B>
    void each(std::pair<A, B> &both, int)
    {
      *this &both.first &both.second;
    }

    /** Of vectors and strings. */
    template <typename T>
    auto each(T &list, long) -> decltype(list.resize(0), void())
    {
      std::uint64_t size = list.size();
      *this        &size;
      if (is_read && size > all.size() - place)
        throw does_not_fit("it ends early");
      list.resize(size);
      using Value = typename T::value_type;
      if constexpr (std::is_arithmetic_v<Value>)
        copy(list.data(), size * sizeof(Value));
      else
        for (auto &value : list)
          *this &value;
    }

    std::string all;
    std::size_t place   = 0;
    bool        is_read = false;
  };
} // namespace Impoint

#endif
