#include <impoint/output/machine.h>

#include <deal.II/base/utilities.h>

#include <dlfcn.h>

namespace Impoint
{
  std::size_t peak_memory(const MPI_Comm communicator)
  {
    Utilities::System::MemoryStats memory;
    Utilities::System::get_memory_stats(memory);
    const std::size_t kilobytes = memory.VmHWM;
    return 1024 * Utilities::MPI::max(kilobytes, communicator);
  }



  BlasInUse blas_in_use()
  {
    // The library is chosen when the program is loaded, and LAPACK may bring
    // another one along: the one that multiplies matrices is asked, by symbols
    // that it or what it is linked to has alone.
    Dl_info     library;
    void *const product = dlsym(RTLD_DEFAULT, "dgemm_");
    if (product == nullptr || dladdr(product, &library) == 0)
      return {"unknown BLAS", false};
    void *const blas = dlopen(library.dli_fname, RTLD_LAZY | RTLD_NOLOAD);
    if (blas == nullptr) // linked statically
      return {"unknown BLAS", false};

    using Text = const char *();
    BlasInUse found{"reference BLAS", true};
    if (void *const config = dlsym(blas, "openblas_get_config"))
      {
        const std::string text = reinterpret_cast<Text *>(config)();
        found = {text.substr(0, text.find(' ', text.find(' ') + 1)), false};
      }
    else if (dlsym(blas, "MKL_Get_Version"))
      found = {"MKL", false};
    else if (dlsym(blas, "bli_info_get_version_str"))
      found = {"BLIS", false};
    dlclose(blas);
    return found;
  }
} // namespace Impoint
