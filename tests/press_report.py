"""Numbers of the flat-bed press's report (平臺印刷機主傳動機構運動簡圖設計) that several tests start from."""

#: Angles of driver φ and follower ψ at its ten positions, deg.
PHI = (176.5468, 186.5587, 196.7699, 207.4588, 218.8301, 231.0278, 244.1497, 258.2710, 273.4776, 289.9133)
PSI = (133.3740, 140.7340, 147.9701, 155.2380, 162.6878, 170.4900, 178.8701, 188.1747, 199.0442, 213.0665)
