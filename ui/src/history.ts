// Steps back and forth without limit, of whatever has states.

export class History<State> {
  private past: State[] = [];
  private future: State[] = [];

  /** `now`: the present state; `go` takes another one. */
  constructor(private readonly now: () => State, private readonly go: (state: State) => void) {}

  get undoable(): boolean {
    return this.past.length > 0;
  }

  get redoable(): boolean {
    return this.future.length > 0;
  }

  /** The state before the change that is being made or was made last. */
  get before(): State | undefined {
    return this.past[this.past.length - 1];
  }

  /** A change begins. */
  mark(): void {
    this.past.push(this.now());
    this.future = [];
  }

  /** The change that was marked last has changed nothing. */
  unmark(): void {
    this.past.pop();
  }

  /** All states, the nearest ones last. */
  get states(): { past: State[]; future: State[] } {
    return { past: this.past, future: this.future };
  }

  /** Goes on with the states of an earlier history. */
  restore({ past, future }: { past: State[]; future: State[] }): void {
    [this.past, this.future] = [past, future];
  }

  clear(): void {
    [this.past, this.future] = [[], []];
  }

  undo(): void {
    this.step(this.past, this.future);
  }

  redo(): void {
    this.step(this.future, this.past);
  }

  private step(from: State[], to: State[]): void {
    const state = from.pop();
    if (state === undefined) return;
    to.push(this.now());
    this.go(state);
  }
}
