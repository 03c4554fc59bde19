// Finds by words that are typed in part: every word must be found, at the beginnings of words first.

const plain = (text: string) => text.normalize("NFKD").replace(/\p{M}/gu, "").toLowerCase();

/** How well a text fits what is typed; 0: not at all. */
export function fit(typed: string, text: string): number {
  const words = plain(typed).split(/\s+/).filter(Boolean), where = plain(text);
  let sum = words.length ? 0 : 1;
  for (const word of words) {
    const found = one(word, where);
    if (!found) return 0;
    sum += found;
  }
  return sum;
}

function one(word: string, text: string): number {
  const at = text.indexOf(word);
  if (at === 0) return 8;
  if (at > 0) return /[\p{L}\p{N}]/u.test(text[at - 1]) && !/\p{Script=Han}/u.test(word) ? 3 : 6;
  // Letters in their order, each run of them from the beginning of a word: "tc" finds "target curve".
  let k = 0, begins = true;
  for (const sign of text) {
    if (k < word.length && sign === word[k] && (begins || (k > 0 && runs(text, word, k)))) k++;
    begins = !/[\p{L}\p{N}]/u.test(sign);
  }
  return k === word.length ? 1 : 0;
}

/** Whether the letter is found behind the one before it. */
const runs = (text: string, word: string, k: number) => text.includes(word.slice(k - 1, k + 1));

export const fits = (typed: string, text: string) => fit(typed, text) > 0;

/** What fits, the best first, else in its order. */
export function ranked<T>(typed: string, all: T[], text: (each: T) => string): T[] {
  const found = all.map((each, k) => ({ each, k, score: fit(typed, text(each)) })).filter(({ score }) => score > 0);
  return found.sort((a, b) => b.score - a.score || a.k - b.k).map(({ each }) => each);
}
