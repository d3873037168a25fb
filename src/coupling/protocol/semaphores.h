#pragma once

namespace quasimc {

/// The pair of System V semaphores of the plant simulator: the first counts its messages, the
/// second the answers. Detects the end of the simulator, which semaphores alone don't show.
class SemaphorePair {
  public:
    /// @throws InputError  if there are no semaphores of that key
    explicit SemaphorePair(long key);
    ~SemaphorePair();
    SemaphorePair(const SemaphorePair&) = delete;
    SemaphorePair& operator=(const SemaphorePair&) = delete;

    /// Signals the start of this process. Until post_last(), the kernel posts the answers of a
    /// killed process as post_forever() does, so that no simulator waits for it.
    void announce();
    /// Waits for a message. @throws PeerDisconnected
    void wait_for_master();
    /// Signals an answer. @throws PeerDisconnected
    void post_to_master();
    /// Signals the last answer. The end of this process then leaves the semaphores unchanged. It is
    /// no error if the simulator has removed them.
    void post_last() const noexcept;
    /// Signals an answer for this and all later queries, also after the end of this process.
    void post_forever() const noexcept;
    /// Throws PeerDisconnected if the simulator has died or removed the semaphores.
    void check() const;
    /// Whether the simulator has died, and can't remove its resources.
    [[nodiscard]] bool master_died() const;
    /// Removes the semaphores of a simulator that has died.
    void remove() const;

  private:
    void set_answers(int count) const noexcept;

    int set_ = -1;
    int maker_ = -1;           // process id; 0 or less if unknown
    int master_ = -1;          // its descriptor; -1 if there is none
    bool died_early_ = false;  // before it could be watched
};

}  // namespace quasimc
