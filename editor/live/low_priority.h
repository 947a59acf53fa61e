#pragma once

namespace sward::editor {

/// Gives the calling thread the lowest priority of an ordinary thread (nice 19), so that the window and its pictures
/// come first; threads that it starts later inherit it. Silently does nothing where the system refuses.
void lowerPriorityOfThisThread();

/// The same by half: below the window, above the bakes (nice 5). For the viewport's pictures.
void yieldPriorityOfThisThread();

/// Starts the threads of the task scheduler from the calling thread, so that they inherit its priority.
void startSchedulerThreads();

}  // namespace sward::editor
