#pragma once

namespace quasimc {

/// The pair of System V semaphores that the plant simulator made: the first counts its messages,
/// the second ours. Notices when the simulator dies, which the semaphores alone don't tell.
class SemaphorePair {
  public:
    /// @throws InputError  if there are no semaphores of that key
    explicit SemaphorePair(long key);
    ~SemaphorePair();
    SemaphorePair(const SemaphorePair&) = delete;
    SemaphorePair& operator=(const SemaphorePair&) = delete;

    /// Tells the simulator that we are there. Until post_last(), the kernel answers for a process
    /// that was killed, as post_forever() does: no simulator waits for it.
    void announce();
    /// Waits for a message. @throws PeerDisconnected
    void wait_for_master();
    /// Says that our answer is there. @throws PeerDisconnected
    void post_to_master();
    /// Says that our last answer is there. Our end then leaves the semaphores as they are. If the
    /// simulator has removed them meanwhile, it has all it wants.
    void post_last() const noexcept;
    /// Says that an answer is there now and will be whenever it is asked for: after us.
    void post_forever() const noexcept;
    /// Throws PeerDisconnected if the simulator has died or removed the semaphores.
    void check() const;
    /// Whether the simulator was seen to have died, and nobody is left who would remove what it
    /// made.
    [[nodiscard]] bool master_died() const;
    /// Removes the semaphores of a simulator that has died.
    void remove() const;

  private:
    void set_answers(int count) const noexcept;

    int set_ = -1;
    int maker_ = -1;           // process id; 0 or less if it can't be told
    int master_ = -1;          // its descriptor; -1 if there is none
    bool died_early_ = false;  // before we looked
};

}  // namespace quasimc
