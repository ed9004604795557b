#ifndef impoint_grid_node_set_h
#define impoint_grid_node_set_h

#include <algorithm>
#include <cstdint>
#include <vector>

namespace Impoint
{
  /**
   * A set of small numbers that gives them back in order: a bit for each
   * possible one, and the words of bits that are in use. Costs what is in it,
   * whatever could be.
   */
  class NodeSet
  {
  public:
    explicit NodeSet(const unsigned int n_nodes)
      : words((n_nodes + bits_of_a_word - 1) / bits_of_a_word, 0)
    {}

    void insert(const unsigned int node)
    {
      Word &word = words[node / bits_of_a_word];
      if (word == 0)
        used.push_back(node / bits_of_a_word);
      word |= Word(1) << node % bits_of_a_word;
    }

    bool contains(const unsigned int node) const
    {
      return words[node / bits_of_a_word] >> node % bits_of_a_word & 1;
    }

    /** Its members, increasing. */
    std::vector<unsigned int> members()
    {
      std::sort(used.begin(), used.end());
      std::vector<unsigned int> result;
      for (const unsigned int w : used)
        for (unsigned int bit = 0; bit < bits_of_a_word; ++bit)
          if (words[w] >> bit & 1)
            result.push_back(w * bits_of_a_word + bit);
      return result;
    }

    void clear()
    {
      for (const unsigned int w : used)
        words[w] = 0;
      used.clear();
    }

  private:
    using Word = std::uint64_t;

    static constexpr unsigned int bits_of_a_word = 64;

    std::vector<Word>         words;
    std::vector<unsigned int> used; // words that are not 0
  };
} // namespace Impoint

#endif
