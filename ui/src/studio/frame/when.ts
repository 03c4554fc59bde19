// Times as people say them: "today 14:02", "yesterday 18:15", "3 Nov", with the year where it is another one.

type Say = (key: string, values?: Record<string, string>) => string;

const two = (x: number) => String(x).padStart(2, "0");
export const clock = (at: Date) => `${two(at.getHours())}:${two(at.getMinutes())}`;
const day = (at: Date) => new Date(at.getFullYear(), at.getMonth(), at.getDate()).getTime();

/** `at`, `now`: ms of the clock. */
export function when(at: number, language: "en" | "zh", say: Say, now = Date.now()): string {
  const then = new Date(at), today = new Date(now), time = clock(then), yesterday = new Date(today.getFullYear(), today.getMonth(), today.getDate() - 1);
  if (day(then) === day(today)) return say("when.today", { time });
  if (day(then) === day(yesterday)) return say("when.yesterday", { time });
  const year = then.getFullYear() === today.getFullYear() ? undefined : "numeric";
  return then.toLocaleDateString(language === "zh" ? "zh-CN" : "en-GB", { day: "numeric", month: language === "zh" ? "long" : "short", year });
}

/** The time alone where it is today's. */
export function moment(at: number, language: "en" | "zh", say: Say, now = Date.now()): string {
  return day(new Date(at)) === day(new Date(now)) ? clock(new Date(at)) : when(at, language, say, now);
}
