// Memory for large arrays on the kernel's large pages: of every container in
// the program, deal.II's included. Loops over points and matrices go through
// tens of megabytes a step, of which the processor finds the pages of four
// kilobytes one by one (in virtual machines by two tables); it takes a third of
// their time. Where the kernel knows no large pages, or not on request, nothing
// changes.

#include <sys/mman.h>

#include <cstdlib>
#include <new>

namespace
{
  constexpr std::size_t large_page = std::size_t(1) << 21;

  /** What is shorter would waste too much of its last page. */
  constexpr std::size_t least = 2 * large_page;

  void *allocate(const std::size_t size)
  {
    if (size < least)
      return std::malloc(size > 0 ? size : 1);
    void *memory = nullptr;
    if (posix_memalign(&memory, large_page, size) != 0)
      return nullptr;
#ifdef MADV_HUGEPAGE
    madvise(memory, size, MADV_HUGEPAGE);
#endif
    return memory;
  }
} // namespace



void *operator new(const std::size_t size)
{
  while (true)
    {
      if (void *memory = allocate(size))
        return memory;
      const std::new_handler make_room = std::get_new_handler();
      if (make_room == nullptr)
        throw std::bad_alloc();
      make_room();
    }
}



void operator delete(void *memory) noexcept
{
  std::free(memory);
}



void operator delete(void *memory, std::size_t) noexcept
{
  std::free(memory);
}
