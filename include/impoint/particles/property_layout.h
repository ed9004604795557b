#ifndef impoint_particles_property_layout_h
#define impoint_particles_property_layout_h

#include <string>
#include <vector>

namespace Impoint
{
  /**
   * What a particle carries, by name: slots in the pool of
   * properties. No other code knows a slot's number.
   */
  class PropertyLayout
  {
  public:
    static constexpr unsigned int absent = static_cast<unsigned int>(-1);

    struct Field
    {
      std::string  name;
      unsigned int slot = 0; // of its first double
      unsigned int size = 0; // doubles
    };

    /** Appends a field and returns its slot; a field of size 0 is absent. */
    unsigned int add(const std::string &name, const unsigned int size)
    {
      if (size == 0)
        return absent;
      all.push_back({name, n, size});
      n += size;
      return all.back().slot;
    }

    unsigned int n_doubles() const
    {
      return n;
    }

    const std::vector<Field> &fields() const
    {
      return all;
    }

  private:
    std::vector<Field> all;
    unsigned int       n = 0;
  };
} // namespace Impoint

#endif
